// The program's text. It follows the executed line until somebody scrolls; a click on a line shows its place.
import { signal } from '@preact/signals';
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from 'preact/hooks';
import { say } from '../core/language';
import { reportWords } from '../core/faults';
import { status } from '../machine/connection';
import { firstLineAt, ProgramText, spacerOf, topForLine } from '../machine/program_text';
import { shown } from '../machine/programs';
import { isUnderWay } from '../machine/words';
import { picked } from '../scene/stage';
import { Code } from './code';
import { PickedLine } from './picked_line';

const follows = signal(true);

export function ProgramView() {
  const program = shown.value;
  const text = useMemo(() => (program === null ? null : new ProgramText(program.id, program.lines)), [program?.id, program?.lines]);
  const box = useRef<HTMLDivElement>(null);
  const probe = useRef<HTMLDivElement>(null);
  const [size, setSize] = useState({ lineHeight: 24, height: 200 });
  const [top, setTop] = useState(0);
  const byItself = useRef(false);

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

  const now = status.value;
  const runs = now !== null && program !== null && isUnderWay(now.job) && now.job?.program === program.id;
  const executed = runs ? now.line : 0;
  const scrolled = { lines: text?.lines ?? 0, ...size };
  const shownLines = size.height / size.lineHeight;
  const goal = follows.value && executed > 0 ? executed : (picked.value ?? 0);

  useEffect(() => {
    if (box.current === null || goal === 0) return;
    const first = firstLineAt(scrolled, box.current.scrollTop);
    const isSeen = goal - 1 >= first + 1 && goal <= first + shownLines - 2;
    if (isSeen) return;
    byItself.current = true;
    box.current.scrollTop = topForLine(scrolled, goal - 1 - shownLines / 3);
  }, [goal, size.height, size.lineHeight]);

  if (program === null || text === null) return null;
  void text.version.value;
  const first = firstLineAt(scrolled, top);
  const firstWhole = Math.floor(first);
  const rows = [];
  for (let i = firstWhole; i < Math.min(text.lines, firstWhole + shownLines + 2); ++i) {
    const number = i + 1;
    const marks = `${number === executed ? 'executed' : ''} ${number === picked.value ? 'picked' : ''}`;
    const finding = program.findings?.find((one) => one.line === number);
    rows.push(
      <button
        type="button"
        key={number}
        tabIndex={-1}
        class={`text-line ${marks} ${finding?.severity ?? ''}`}
        style={{ transform: `translateY(${(i - first) * size.lineHeight}px)` }}
        aria-current={number === executed ? 'step' : undefined}
        title={finding === undefined ? undefined : reportWords(finding.message, finding.message_sentence)}
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
    if (way === undefined || runs) return;
    event.preventDefault();
    picked.value = Math.min(text.lines, Math.max(1, picked.value === null ? firstWhole + 1 : picked.value + way));
  };
  const scroll = (): void => {
    if (box.current === null) return;
    setTop(box.current.scrollTop);
    if (!byItself.current && runs) follows.value = false;
    byItself.current = false;
  };
  return (
    <div class="panel text">
      <div class="text-box" ref={box} onScroll={scroll} onKeyDown={pickByKey} tabIndex={0} role="region" aria-label={say('run.program')}>
        <div class="text-spacer" style={{ height: `${spacerOf(scrolled)}px` }}>
          <div class="text-window" style={{ height: `${size.height}px` }}>
            <div class="text-line probe" ref={probe} aria-hidden="true">
              0
            </div>
            {rows}
          </div>
        </div>
      </div>
      {!runs && <PickedLine />}
      {runs && !follows.value && (
        <button type="button" class="chip text-follow" onClick={() => (follows.value = true)}>
          {say('run.follow')}
        </button>
      )}
    </div>
  );
}
