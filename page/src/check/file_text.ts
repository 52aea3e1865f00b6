// The text of the visitor's program, one window at a time, because it may have millions of lines. Like the reader of
// programs, it ends a line at LF, CR or CR LF.
import { signal } from '@preact/signals';

const marked = 1024; // lines between two known places
const piece = 4 << 20; // bytes
const mostWindows = 40;
const longestShown = 400; // characters

export class FileText {
  private readonly starts: number[] = [0]; // of line 1, 1025, …
  private readonly windows = new Map<number, string[]>();
  private readonly asked = new Set<number>();
  private ended = false;
  readonly lines = signal(0);
  // Grows when lines have come.
  readonly version = signal(0);

  constructor(private readonly file: File) {
    void this.count();
  }
  end(): void {
    this.ended = true;
  }

  // Line 1 is the first. Undefined: the line is not loaded yet, and this call requests it.
  line(number: number): string | undefined {
    const index = Math.floor((number - 1) / marked);
    const found = this.windows.get(index);
    if (found === undefined) void this.fetch(index);
    return found?.[(number - 1) % marked];
  }

  private async count(): Promise<void> {
    let lines = 0;
    let last = 10; // the byte before
    const begin = (at: number): void => {
      ++lines;
      if (lines % marked === 0) this.starts.push(at);
    };
    try {
      for (let from = 0; from < this.file.size && !this.ended; from += piece) {
        const bytes = new Uint8Array(await this.file.slice(from, from + piece).arrayBuffer());
        for (let i = 0; i < bytes.length; ++i) {
          const byte = bytes[i]!;
          if (last === 13 && byte !== 10) begin(from + i);
          if (byte === 10) begin(from + i + 1);
          last = byte;
        }
      }
      if (last !== 10 && this.file.size > 0) ++lines;
    } catch {
      // The file has changed or was deleted: the check reports it.
    }
    this.lines.value = Math.max(1, lines);
  }

  private async fetch(index: number): Promise<void> {
    const from = this.starts[index];
    if (this.asked.has(index) || from === undefined || this.lines.peek() === 0) return;
    this.asked.add(index);
    try {
      // A line has at most `piece` bytes; of a longer window, only the beginning is shown.
      const to = Math.min(this.starts[index + 1] ?? this.file.size, from + piece);
      const text = await this.file.slice(from, to).text();
      this.windows.set(index, text.split(/\r\n|\n|\r/).map((one) => one.slice(0, longestShown)));
      const oldest = this.windows.keys().next().value;
      if (this.windows.size > mostWindows && oldest !== undefined) this.windows.delete(oldest);
      ++this.version.value;
    } catch {
      // The next call of line() requests it again.
    } finally {
      this.asked.delete(index);
    }
  }
}
