// The lines of a program in a box that scrolls: only those that can be seen are in the document. A click on a line, or the
// arrow keys, pick it.
import type { ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { firstLineAt, spacerOf, topForLine } from '../machine/program_text';
import { picked } from '../scene/stage';
import { Code } from './code';

export interface TextLines {
  lines: number;
  line: (number: number) => string | null | undefined; // counts from 1
}
export interface LineMark {
  classes?: string | undefined;
  executed?: boolean;
  title?: string | undefined;
}

interface TextBoxProps {
  text: TextLines;
  label: string;
  goal: number; // this line is scrolled into view; 0: none
  mark: (number: number) => LineMark;
  locked?: boolean; // the keys pick nothing
  onScroll?: () => void; // somebody scrolled
  classes?: string;
  children?: ComponentChildren;
}

export function TextBox({ text, label, goal, mark, locked, onScroll, classes, children }: TextBoxProps) {
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
  }, [text.line]);

  const scrolled = { lines: text.lines, ...size };
  const shownLines = size.height / size.lineHeight;
  useEffect(() => {
    if (box.current === null || goal === 0) return;
    const first = firstLineAt(scrolled, box.current.scrollTop);
    const isSeen = goal - 1 >= first + 1 && goal <= first + shownLines - 2;
    if (isSeen) return;
    byItself.current = true;
    box.current.scrollTop = topForLine(scrolled, goal - 1 - shownLines / 3);
  }, [goal, text.lines, size.height, size.lineHeight]);

  const first = firstLineAt(scrolled, top);
  const firstWhole = Math.floor(first);
  const rows = [];
  for (let i = firstWhole; i < Math.min(text.lines, firstWhole + shownLines + 2); ++i) {
    const number = i + 1;
    const { classes: marks = '', executed = false, title } = mark(number);
    rows.push(
      <button
        type="button"
        key={number}
        tabIndex={-1}
        class={`text-line ${executed ? 'executed' : ''} ${number === picked.value ? 'picked' : ''} ${marks}`}
        style={{ transform: `translateY(${(i - first) * size.lineHeight}px)` }}
        aria-current={executed ? 'step' : undefined}
        title={title}
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
    if (way === undefined || locked === true) return;
    event.preventDefault();
    picked.value = Math.min(text.lines, Math.max(1, picked.value === null ? firstWhole + 1 : picked.value + way));
  };
  const scroll = (): void => {
    if (box.current === null) return;
    setTop(box.current.scrollTop);
    if (!byItself.current) onScroll?.();
    byItself.current = false;
  };
  return (
    <div class={`panel text ${classes ?? ''}`}>
      <div class="text-box" ref={box} onScroll={scroll} onKeyDown={pickByKey} tabIndex={0} role="region" aria-label={label}>
        <div class="text-spacer" style={{ height: `${spacerOf(scrolled)}px` }}>
          <div class="text-window" style={{ height: `${size.height}px` }}>
            <div class="text-line probe" ref={probe} aria-hidden="true">
              0
            </div>
            {rows}
          </div>
        </div>
      </div>
      {children}
    </div>
  );
}
