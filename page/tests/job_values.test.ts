// Keys of operations in a job file: what a field shows of them, and what it means.
import { describe, expect, it } from 'vitest';
import type { JobFile, JobOperation, Shape } from '../src/machine/job_file';
import { drawingsOf, ownerOf, selects, textOf, usersOf, valueOf, withDrawing } from '../src/pages/cam_job_values';

const length = { 'x-kind': 'length', type: ['string', 'number'] };
const layer = { 'x-kind': 'text', type: ['string', 'array'] };

describe('a value', () => {
  it('is shown as it can be typed again', () => {
    const rows = [
      [length, -3], [length, '1/8in'], [{ 'x-kind': 'place', type: 'string' }, [10, 0]], [layer, 'a'], [layer, ['a', 'b']],
      [{ 'x-kind': 'length', type: ['string', 'array'] }, [[10, 0], [40, 0]]], [{ 'x-kind': 'number', type: 'number' }, 0.5], [{ 'x-kind': 'text', type: 'string' }, 'A, B; C'],
    ] as const;
    for (const [row, value] of rows) {
      const copy = JSON.parse(JSON.stringify([row, value])) as [Parameters<typeof valueOf>[0], Parameters<typeof textOf>[0]];
      expect(valueOf(copy[0], textOf(copy[1])), JSON.stringify(value)).toEqual(value);
    }
  });
  it('of an empty field is none, and a layer with a number as its name is a text', () => {
    expect(valueOf(length, '  ')).toBeUndefined();
    expect(valueOf(layer, '0')).toBe('0');
    expect(valueOf(layer, '0, 1')).toEqual(['0', '1']);
    expect(valueOf(length, 'deep')).toBe('deep');
  });
});

const shape = (layerName: string, color: string, names: string[]): Shape => ({ layer: layerName, color, names, d: '', closed: true });
const operation = (values: JobOperation['values'], line = 1, lines: Record<string, number> = {}): JobOperation => ({ line, values, lines });

describe('an operation', () => {
  it('selects shapes by layer, colour and name together', () => {
    const red = shape('a', '#ff0000', ['window', 'left']);
    expect(selects(operation({}), red)).toBe(true);
    expect(selects(operation({ layer: 'a', color: 'Red' }), red)).toBe(true);
    expect(selects(operation({ layer: ['b', 'a'], color: '#F00' }), red)).toBe(true);
    expect(selects(operation({ color: 'blue' }), red)).toBe(false);
    expect(selects(operation({ name: ['left'] }), red)).toBe(true);
    expect(selects(operation({ name: 'right' }), red)).toBe(false);
  });
  it('has the findings of its lines', () => {
    const file = { operations: [operation({}, 5, { kind: 6, tab: 9 }), operation({}, 12, { kind: 13 })], job: { drawing: ['a.svg', 'b.svg'] } } as unknown as JobFile;
    expect([4, 5, 9, 10, 12, 13, 14].map((line) => ownerOf(file, line))).toEqual([-1, 0, 0, -1, 1, 1, -1]);
    expect(drawingsOf(file)).toEqual(['a.svg', 'b.svg']);
    expect(drawingsOf(file, operation({ drawing: 'c.svg' }))).toEqual(['c.svg']);
  });
});

describe('a job', () => {
  it('has one drawing as a text, several as a list, and none as no key', () => {
    expect(withDrawing([], 'a.svg', true)).toBe('a.svg');
    expect(withDrawing(['a.svg'], 'b.svg', true)).toEqual(['a.svg', 'b.svg']);
    expect(withDrawing(['a.svg'], 'a.svg', true)).toBe('a.svg');
    expect(withDrawing(['a.svg', 'b.svg'], 'a.svg', false)).toBe('b.svg');
    expect(withDrawing(['a.svg'], 'a.svg', false)).toBeUndefined();
  });
  it('tells which operations cut with a tool, as their first or second one', () => {
    const file = { operations: [operation({ tool: 1 }), operation({ tool: 2, 'rough-tool': 1 }), operation({ tool: '3' })] } as unknown as JobFile;
    expect([1, 2, 3, 4].map((tool) => usersOf(file, tool, ['tool', 'rough-tool']))).toEqual([[1, 2], [2], [3], []]);
  });
});
