// The text of the shown program, a window at a time: it may have millions of lines.
import { signal } from '@preact/signals';
import { ask } from './api';

const windowLines = 200;
const mostWindows = 60;

export class ProgramText {
  private readonly windows = new Map<number, string[]>();
  private readonly asked = new Set<number>();
  // Grows when lines have come.
  readonly version = signal(0);

  constructor(
    private readonly program: number,
    readonly lines: number,
  ) {}

  // Line 1 is the first. Undefined: it has not come yet, and is asked for.
  line(number: number): string | undefined {
    const index = Math.floor((number - 1) / windowLines);
    const found = this.windows.get(index);
    if (found === undefined) void this.fetch(index);
    return found?.[(number - 1) % windowLines];
  }

  private async fetch(index: number): Promise<void> {
    if (this.asked.has(index)) return;
    this.asked.add(index);
    try {
      const path = `/programs/${this.program}/text?from=${index * windowLines + 1}&lines=${windowLines}`;
      const text = await (await ask('GET', path)).text();
      this.windows.set(index, text.split(/\r?\n/));
      const oldest = this.windows.keys().next().value;
      if (this.windows.size > mostWindows && oldest !== undefined) this.windows.delete(oldest);
      ++this.version.value;
    } catch {
      // Asked again when it is next looked at.
    } finally {
      this.asked.delete(index);
    }
  }
}

// Where a list of so many lines is scrolled to. A browser knows no more than some millions of pixels, so that a long
// text moves by more than a line for each line's height.
export interface Scrolled {
  lines: number;
  lineHeight: number;
  height: number; // of the window
}
const mostPixels = 6e6;

export const spacerOf = ({ lines, lineHeight, height }: Scrolled): number => Math.max(height, Math.min(lines * lineHeight, mostPixels));

export function firstLineAt(scrolled: Scrolled, top: number): number {
  const room = spacerOf(scrolled) - scrolled.height;
  const hidden = scrolled.lines - scrolled.height / scrolled.lineHeight;
  return room <= 0 || hidden <= 0 ? 0 : (Math.min(top, room) / room) * hidden;
}

export function topForLine(scrolled: Scrolled, first: number): number {
  const room = spacerOf(scrolled) - scrolled.height;
  const hidden = scrolled.lines - scrolled.height / scrolled.lineHeight;
  return hidden <= 0 ? 0 : (Math.min(Math.max(first, 0), hidden) / hidden) * room;
}
