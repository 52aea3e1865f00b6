// What the table of tools says about a life.
import { afterEach, describe, expect, it } from 'vitest';
import { language } from '../src/core/language';
import { cutWords, timeWords, usedShare, type MachineTool } from '../src/machine/tool_life';

const tool: MachineTool = {
  number: 3, name: 'T3', pocket: null, length_mm: null, cut_mm: 212_400, cut_s: 5400, life_mm: 300_000, life_s: null, replaced_at: null,
};

afterEach(() => (language.value = 'en'));

describe('the life of a tool', () => {
  it('is used by the limit that is nearer', () => {
    expect(usedShare(tool)).toBeCloseTo(0.708);
    expect(usedShare({ ...tool, life_s: 6000 })).toBeCloseTo(0.9);
    expect(usedShare({ ...tool, life_mm: null, life_s: 3600 })).toBeCloseTo(1.5);
    expect(usedShare({ ...tool, life_mm: null })).toBeNull();
  });

  it('is said in metres and minutes, with the limit where there is one', () => {
    expect(cutWords(tool)).toBe('212.4 of 300.0 m');
    expect(timeWords(tool)).toBe('90.0 min');
    language.value = 'it';
    expect(cutWords(tool)).toBe('212.4 di 300.0 m');
  });
});
