// The program's text beside the results. A finding picks its line.
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { firstLineAt, spacerOf, topForLine } from '../machine/program_text';
import { Code } from '../parts/code';
import { picked } from '../scene/stage';
import type { CheckFinding } from './answer';
import type { FileText } from './file_text';
import { say } from './words';

export function ProgramLines({ text, findings }: { text: FileText; findings: readonly CheckFinding[] }) {
  const box = useRef<HTMLDivElement>(null);
  const probe = useRef<HTMLDivElement>(null);
  const [size, setSize] = useState({ lineHeight: 24, height: 200 });
  const [top, setTop] = useState(0);
  useLayoutEffect(() => {
    const measure = (): void => {
      if (box.current === null || probe.current === null) return;
      setSize({ lineHeight: probe.current.getBoundingClientRect().height || 24, height: box.current.clientHeight });
    };
    measure();
    const observer = new ResizeObserver(measure);
    if (box.current !== null) observer.observe(box.current);
    return () => observer.disconnect();
  }, [text]);

  const lines = text.lines.value;
  void text.version.value;
  const scrolled = { lines, ...size };
  const shownLines = size.height / size.lineHeight;
  const goal = picked.value ?? 0;
  useEffect(() => {
    if (box.current === null || goal === 0) return;
    const first = firstLineAt(scrolled, box.current.scrollTop);
    if (goal - 1 >= first + 1 && goal <= first + shownLines - 2) return;
    box.current.scrollTop = topForLine(scrolled, goal - 1 - shownLines / 3);
  }, [goal, lines, size.height]);

  const first = firstLineAt(scrolled, top);
  const firstWhole = Math.floor(first);
  const rows = [];
  for (let i = firstWhole; i < Math.min(lines, firstWhole + shownLines + 2); ++i) {
    const number = i + 1;
    const finding = findings.find((one) => one.line === number);
    rows.push(
      <button
        type="button"
        key={number}
        tabIndex={-1}
        class={`text-line ${number === picked.value ? 'picked' : ''} ${finding?.severity ?? ''}`}
        style={{ transform: `translateY(${(i - first) * size.lineHeight}px)` }}
        onClick={() => (picked.value = picked.value === number ? null : number)}
      >
        <span class="text-number">{number}</span>
        <Code text={text.line(number) ?? ''} />
      </button>,
    );
  }
  // The arrows pick a line, as a click does.
  const pickByKey = (event: KeyboardEvent): void => {
    const steps: Record<string, number> = { ArrowUp: -1, ArrowDown: 1, PageUp: -Math.floor(shownLines), PageDown: Math.floor(shownLines) };
    const way = steps[event.key];
    if (way === undefined) return;
    event.preventDefault();
    picked.value = Math.min(lines, Math.max(1, picked.value === null ? firstWhole + 1 : picked.value + way));
  };
  return (
    <div class="panel text check-text">
      <div class="text-box" ref={box} onScroll={() => setTop(box.current?.scrollTop ?? 0)} onKeyDown={pickByKey} tabIndex={0} role="region" aria-label={say('program')}>
        <div class="text-spacer" style={{ height: `${spacerOf(scrolled)}px` }}>
          <div class="text-window" style={{ height: `${size.height}px` }}>
            <div class="text-line probe" ref={probe} aria-hidden="true">
              0
            </div>
            {rows}
          </div>
        </div>
      </div>
    </div>
  );
}
