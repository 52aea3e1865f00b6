// Keeps the drawn stock as far cut as the machine has come.
import { pathIndex, pathLoaded } from '../machine/path_index';
import { workOffset } from '../machine/place';
import type { Vector } from './path_data';
import { baseChunks } from './path_loader';
import { doneOf, type Done } from './progress';
import type { Renderer } from './renderer';
import { blockOf } from './stock_cutter';
import { cutters, stockCutter } from './stock_view';

// So long the stock is cut before each picture, ms: as long as a slow picture takes, or nothing would be cut in time.
const cuttingFor = (cost: number): number => Math.min(Math.max(12, cost), 100);

export class StockScene {
  private begun = ''; // what is cut, in words
  private reached: Done | 'all' = { chunk: 0, share: 0 };

  constructor(private readonly renderer: Renderer) {}

  // `cost`: how long the last picture took, ms. `line`: the executed one; null: no job runs, and the whole program is cut. True: there is more to cut.
  advance(line: number | null, tool: Vector | null, cost: number): boolean {
    const cutter = stockCutter.peek();
    const index = pathIndex.peek();
    if (cutter === null || index?.cuts == null || index.work === null || pathLoaded.peek() < 1) {
      if (this.begun !== '') this.renderer.stock.end();
      this.begun = '';
      return false;
    }
    const tools = cutters.peek();
    const zero = workOffset.peek().z ?? 0;
    const chunks = baseChunks();
    const done = line === null || tool === null ? null : doneOf(chunks, line, tool);
    const begun = JSON.stringify([index.program, index.points, index.cuts, tools, zero]);
    const goesBack = done !== null && (this.reached === 'all' || done.chunk < this.reached.chunk || (done.chunk === this.reached.chunk && done.share < this.reached.share));
    if (begun !== this.begun || goesBack) {
      this.renderer.stock.end();
      this.begun = begun;
      // As deep as the tips go, and not the spindle.
      const cuts = { low: [...index.cuts.low] as Vector, high: [...index.cuts.high] as Vector };
      [cuts.low[2], cuts.high[2]] = [index.work.low[2] + zero, index.work.high[2] + zero];
      const widest = Math.max(...tools.map((one) => one.shape.diameter));
      if (cutter.begin(blockOf(cuts, zero, widest), tools) && cutter.shape !== null) this.renderer.stock.begin(cutter.shape);
    }
    this.reached = done ?? 'all';
    const more = cutter.cut(chunks, done === null || tool === null ? null : { ...done, tool }, cuttingFor(cost));
    const changed = cutter.changed();
    if (changed !== null) this.renderer.stock.write(changed.first, changed.heights);
    return more;
  }
}
