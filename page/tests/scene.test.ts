import { describe, expect, it } from 'vitest';
import { axesOf, fit, pan, project, views, zoom, type View } from '../src/scene/camera';
import { gridStep } from '../src/scene/furniture';
import { colourOf } from '../src/scene/gl';
import { placeAt, readChunks, speedCode, spotOfLine } from '../src/scene/path_data';
import { pick } from '../src/scene/pick';
import { doneOf } from '../src/scene/progress';

// Points on a line of 65.535 mm along X; the second motion is a rapid.
function chunk(xs: number[], lines: number[]): ArrayBuffer {
  const bytes = new ArrayBuffer(40 + xs.length * 12);
  const view = new DataView(bytes);
  [0x50534150, xs.length, 3, 0].forEach((value, i) => view.setUint32(i * 4, value, true));
  [10, 20, 0, 0.001, 0.001, 0].forEach((value, i) => view.setFloat32(16 + i * 4, value, true));
  xs.forEach((x, i) => {
    view.setUint16(40 + i * 8, x, true);
    view.setUint16(40 + i * 8 + 6, i === 2 ? 1 : 0, true);
    view.setUint32(40 + xs.length * 8 + i * 4, lines[i] ?? 0, true);
  });
  return bytes;
}
const bytesOf = () => chunk([0, 1000, 2000, 65535], [4, 4, 5, 9]);
const points = () => readChunks(bytesOf())[0]!;

describe('a chunk of the path', () => {
  it('has the speed as the daemon codes it', () => {
    expect(speedCode(60)).toBe(96);
    expect(Math.abs(2 ** (speedCode(1500) / 16 - 6) - 25)).toBeLessThan(0.6);
    expect([speedCode(0.001), speedCode(1e9)]).toEqual([1, 255]);
  });

  it('is read as the daemon writes it', () => {
    const read = points();
    expect([read.chunk, read.level, read.count]).toEqual([3, 0, 4]);
    expect(placeAt(read, 1)[0]).toBeCloseTo(11, 5);
    expect(placeAt(read, 3)[1]).toBeCloseTo(20, 5);
    expect([...read.lines]).toEqual([4, 4, 5, 9]);
  });

  it('may follow another one', () => {
    const one = new Uint8Array(bytesOf());
    const all = readChunks(new Uint8Array([...one, ...one]).buffer);
    expect(all.map((each) => [each.count, placeAt(each, 1)[0], each.lines[3]])).toEqual([0, 1].map(() => [4, expect.closeTo(11, 5), 9]));
  });

  it('is refused when it is cut off or something else', () => {
    expect(() => readChunks(chunk([0, 1], [1, 1]).slice(0, 50))).toThrow();
    expect(() => readChunks(new ArrayBuffer(64))).toThrow();
    const one = new Uint8Array(bytesOf());
    expect(() => readChunks(new Uint8Array([...one, 1, 2]).buffer)).toThrow();
  });

  it('tells the place of a line, and of the nearest one that is there', () => {
    expect(spotOfLine([points()], 9)?.place[0]).toBeCloseTo(75.535, 3);
    expect(spotOfLine([points()], 6)?.line).toBe(5);
    expect(spotOfLine([], 6)).toBeNull();
  });

  it('tells what is done: the motion of the executed line that is nearest to the tool', () => {
    expect(doneOf([points()], 5, [11.5, 20, 0])).toEqual({ chunk: 3, share: 1 / 3 });
    expect(doneOf([points()], 7, [0, 0, 0])?.share).toBeCloseTo(2 / 3);
    expect(doneOf([points()], 3, [0, 0, 0])).toBeNull();
  });
});

describe('the camera', () => {
  const view: View = { centre: [10, 20, 0], ...views.top, scale: 0.1 };

  it('looks down with X to the right and Y up', () => {
    const [x, y] = project(view, axesOf(view), [11, 22, 5]);
    expect(x).toBeCloseTo(10);
    expect(y).toBeCloseTo(-20);
  });

  it('keeps the place under the pointer while it zooms', () => {
    const tilted: View = { ...view, ...views.iso };
    const axes = axesOf(tilted);
    const before: [number, number] = project(tilted, axes, [12, 21, 1]);
    const after = project(zoom(tilted, 0.5, ...before), axes, [12, 21, 1]);
    expect(after[0]).toBeCloseTo(before[0]);
    expect(after[1]).toBeCloseTo(before[1]);
  });

  it('moves with the pointer, and shows all of a box', () => {
    const moved = project(pan(view, 7, -3), axesOf(view), [10, 20, 0]);
    expect(moved[0]).toBeCloseTo(7);
    expect(moved[1]).toBeCloseTo(-3);
    const all = fit({ ...view, ...views.iso }, [0, 0, -5], [300, 100, 5], 800, 400);
    for (const corner of [[0, 0, -5], [300, 100, 5], [300, 0, 5]] as const) {
      const [x, y] = project(all, axesOf(all), [...corner]);
      expect(Math.abs(x)).toBeLessThanOrEqual(400);
      expect(Math.abs(y)).toBeLessThanOrEqual(200);
    }
  });

  it('finds the motion under the pointer', () => {
    expect(pick([points()], view, 5, 1, 8, true)?.line).toBe(4);
    expect(pick([points()], view, 15, 0, 8, true)?.line).toBe(5);
    expect(pick([points()], view, 15, 0, 8, false)?.line, 'a rapid that is not shown').not.toBe(5);
    expect(pick([points()], view, 5, 60, 8, true)).toBeNull();
  });
});

describe('drawing', () => {
  it('has a grid of round steps and colours as numbers', () => {
    expect(gridStep(100)).toBe(10);
    expect(gridStep(500)).toBe(50);
    expect(colourOf('#ff0080')).toEqual([1, 0, 128 / 255]);
    expect(colourOf('#fff')).toEqual([1, 1, 1]);
  });
});
