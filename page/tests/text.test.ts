import { describe, expect, it } from 'vitest';
import { search, type LogLine } from '../src/machine/log';
import { firstLineAt, spacerOf, topForLine } from '../src/machine/program_text';

describe('a long text in a window', () => {
  for (const lines of [5, 200, 1_000_000, 30_000_000]) {
    it(`shows the first and the last of ${lines} lines`, () => {
      const scrolled = { lines, lineHeight: 24, height: 480 };
      const room = spacerOf(scrolled) - scrolled.height;
      expect(firstLineAt(scrolled, 0)).toBe(0);
      expect(firstLineAt(scrolled, room)).toBeCloseTo(Math.max(0, lines - 20));
      expect(spacerOf(scrolled)).toBeLessThan(10_000_000);
      const middle = Math.floor(lines / 2);
      if (lines > 100) expect(firstLineAt(scrolled, topForLine(scrolled, middle))).toBeCloseTo(middle, 3);
    });
  }
});

describe('the log', () => {
  it('finds lines that have all the words', () => {
    const line = (id: number, words: string): LogLine => ({ id, at: new Date(0), kind: 'state', words, hint: '' });
    const lines = [line(1, 'part.ngc: done'), line(2, 'Ready'), line(3, 'part.ngc: failed')];
    expect(search(lines, 'DONE part').map((one) => one.id)).toEqual([1]);
    expect(search(lines, '').length).toBe(3);
  });
});
