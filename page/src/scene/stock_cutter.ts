// The stock as it is cut: the program's own sweep (src/stock) in the browser, along the loaded path up to where the
// machine is. Without a job it is cut by the whole program.
import { placeAt, type PathPoints, type Vector } from './path_data';

export type ToolKind = 'flat' | 'ball' | 'vee' | 'bull' | 'taper';
export interface StockTool {
  kind: ToolKind;
  diameter: number; // mm
  angle: number; // degrees between the flanks of a cone
  tip: number; // mm: diameter of a cone's tip; radius of round corners
}
// What cuts a part of the path. Its tip is lower than the path's place by `length`, which the program has corrected.
export interface Cutter {
  shape: StockTool;
  length: number;
}
export interface Block {
  low: Vector;
  high: Vector;
}
export interface HeightTexture {
  columns: number;
  rows: number;
  cell: number;
  block: Block;
}
// How far it is to be cut: in this chunk so many of its motions, and then on to the tool's place. Null: all.
export interface CutTo {
  chunk: number;
  share: number;
  tool: Vector;
}

const mostCells = 200_000; // a scene that turns has to draw them
const kinds: readonly ToolKind[] = ['flat', 'ball', 'vee', 'bull', 'taper'];
type Call = (...numbers: number[]) => number;

// The block that the feeds need, as `passo simulate` takes it: as wide as the tool goes, its top at the work's zero or the
// highest cut, a little left below the deepest cut.
export function blockOf(cuts: Block, zero: number, diameter: number): Block {
  const rim = diameter / 2;
  const top = Math.max(zero, cuts.low[2] + 1e-3);
  const left = Math.max(1, (top - cuts.low[2]) * 0.25);
  return { low: [cuts.low[0] - rim, cuts.low[1] - rim, cuts.low[2] - left], high: [cuts.high[0] + rim, cuts.high[1] + rim, top] };
}

// 1, 2 or 5 times a power of ten.
export function cellOf(block: Block): number {
  const area = (block.high[0] - block.low[0]) * (block.high[1] - block.low[1]);
  const least = Math.sqrt(area / mostCells);
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5, 10].find((one) => one * power >= least) ?? 10);
}

export class StockCutter {
  private chunk = 0; // which of the path is cut next
  private point = 1;
  private texture: HeightTexture | null = null;
  private tools: readonly Cutter[] = [];
  private tool = -1; // which one is in; below 0: none

  constructor(private readonly exports: WebAssembly.Exports) {}

  private call(name: string, ...numbers: number[]): number {
    return (this.exports[`stock_${name}`] as Call)(...numbers);
  }

  // `tools`: in the order in which the path counts them.
  begin(block: Block, tools: readonly Cutter[]): boolean {
    const cell = cellOf(block);
    this.chunk = 0;
    this.point = 1;
    this.tools = tools;
    this.tool = -1;
    const good = this.call('begin', ...block.low, ...block.high, cell);
    this.texture = good ? { columns: this.call('columns'), rows: this.call('rows'), cell, block } : null;
    return this.texture !== null;
  }
  get shape(): HeightTexture | null {
    return this.texture;
  }

  // Cuts for at most so long. True: there is more to do.
  cut(all: readonly PathPoints[], to: CutTo | null, most: number): boolean {
    if (this.texture === null) return false;
    const end = performance.now() + most;
    const [a, b]: [Vector, Vector] = [[0, 0, 0], [0, 0, 0]];
    for (;;) {
      const points = all[this.chunk];
      if (points === undefined || (to !== null && points.chunk > to.chunk)) return false;
      const isLast = to !== null && points.chunk === to.chunk;
      const last = isLast ? Math.min(points.count, 1 + Math.floor(to.share * (points.count - 1))) : points.count;
      for (; this.point < last; ++this.point) {
        const cutter = this.put(points, this.point);
        placeAt(points, this.point - 1, a);
        placeAt(points, this.point, b);
        if (cutter !== null) this.call('cut', a[0], a[1], a[2] - cutter.length, b[0], b[1], b[2] - cutter.length);
        if ((this.point & 63) === 0 && performance.now() > end) return true;
      }
      if (isLast) {
        // The motion that is being made.
        placeAt(points, Math.max(0, this.point - 1), a);
        const cutter = this.put(points, Math.min(this.point, points.count - 1));
        const [x, y, z] = to.tool;
        if (cutter !== null) this.call('cut', a[0], a[1], a[2] - cutter.length, x, y, z - cutter.length);
        return false;
      }
      ++this.chunk;
      this.point = 1;
    }
  }

  // The tool that makes the motion to this point. Null: there is no such tool.
  private put(points: PathPoints, point: number): Cutter | null {
    const next = points.tools.findIndex((one) => one.from > point);
    const part = points.tools.at(next < 0 ? -1 : Math.max(0, next - 1));
    const wanted = Math.min(part?.tool ?? 0, this.tools.length - 1);
    const cutter = this.tools[wanted] ?? null;
    if (cutter === null || wanted === this.tool) return cutter;
    const { kind, diameter, angle, tip } = cutter.shape;
    const good = this.call('tool', kinds.indexOf(kind), diameter, angle, tip) !== 0;
    this.tool = good ? wanted : -1;
    return good ? cutter : null;
  }

  // The rows that have changed since the last call, from the top down in mm. Null: none.
  changed(): { first: number; heights: Float32Array[] } | null {
    const [first, last] = [this.call('first'), this.call('last')];
    if (first > last || this.texture === null) return null;
    this.call('seen');
    const memory = (this.exports.memory as WebAssembly.Memory).buffer;
    const heights: Float32Array[] = [];
    for (let row = first; row <= last; ++row) heights.push(new Float32Array(memory, this.call('row', row), this.texture.columns));
    return { first, heights };
  }
}
