import { describe, expect, it } from 'vitest';
import { mapTarget } from '../src/machine/programs';
import type { Program } from '../src/machine/api';
import { formFor, forms, isDrawing } from '../src/pages/cam_forms';
import { knowOperations } from './description';
import { readChunks } from '../src/scene/path_data';
import { isGoodTool } from '../src/scene/tool_file';

describe('a tool', () => {
  it('has only tools that can be', () => {
    expect(isGoodTool({ kind: 'bull', diameter: 6, angle: 60, tip: 3 })).toBe(false);
    expect(isGoodTool({ kind: 'vee', diameter: 6, angle: 180, tip: 0 })).toBe(false);
    expect(isGoodTool({ kind: 'taper', diameter: 6, angle: 10, tip: 6 })).toBe(true);
    expect(isGoodTool({ kind: 'flat', diameter: NaN, angle: 60, tip: 0 })).toBe(false);
  });
});

describe('a chunk of the path', () => {
  it('tells its tools, and keeps their bits free for the torque', () => {
    const bytes = new ArrayBuffer(40 + 4 * 12);
    const view = new DataView(bytes);
    [0x50534150, 4, 0, 0].forEach((value, i) => view.setUint32(4 * i, value, true));
    [0, 1 | (3 << 1), 96 << 8, (96 << 8) | (3 << 1)].forEach((flags, i) => view.setUint16(40 + 8 * i + 6, flags, true));
    const read = readChunks(bytes)[0]!;
    expect(read.tools).toEqual([
      { from: 0, tool: 0 },
      { from: 1, tool: 3 },
      { from: 2, tool: 0 },
      { from: 3, tool: 3 },
    ]);
    expect([1, 2, 3].map((i) => read.places[4 * i + 3])).toEqual([1, 96 << 8, 96 << 8]);
  });
});

describe('a height map', () => {
  const program = (id: number, name: string) => ({ id, name }) as Program;
  it('is for a program of the user, never for a probing cycle that has just ended', () => {
    const all = [program(1, 'part.ngc'), program(2, 'other.ngc'), program(3, 'probe surface'), program(4, 'console.ngc')];
    expect(mapTarget(all, 1, null)?.id).toBe(1);
    expect(mapTarget(all, 3, 1)?.id).toBe(1);
    expect(mapTarget(all, 3, null)?.id).toBe(2);
    expect(mapTarget(all.slice(2), 3, null)).toBeNull();
  });
});

describe('the forms of CAM', () => {
  knowOperations();
  const at = (job: string) => forms.value.find((one) => one.job === job);
  it('make a whole board of several files, of a zip, and one job of one file', () => {
    expect(formFor(['a-F_Cu.gbr', 'a.drl'], at('drill'))?.job).toBe('board');
    expect(formFor(['board.zip'], at('profile'))?.job).toBe('board');
    expect(formFor(['a.drl'], at('profile'))?.job).toBe('drill');
    expect(formFor(['a.drl'], at('board'))?.job).toBe('board');
    expect(formFor(['root.dat', 'tip.dat'], at('profile'))?.job).toBe('wire');
    expect(formFor(['a.svg', 'b.svg'], at('pocket'))?.job).toBe('pocket');
  });
  it('take drawings, and leave programs alone', () => {
    for (const name of ['a.zip', 'a.kicad_pcb', 'a.hpgl', 'a.TIF', 'a.GTL']) expect(isDrawing(name), name).toBe(true);
    for (const name of ['a.ngc', 'a.nc', 'a.txt', 'a']) expect(isDrawing(name), name).toBe(false);
  });
});
