// Whether the scene shows the stock, and by which tools it is cut. The module comes when somebody wants to see it.
import { computed, signal } from '@preact/signals';
import { kept } from '../core/kept';
import { loadModule } from '../core/wasm';
import { pathIndex, type UsedTool } from '../machine/path_index';
import { workOffset } from '../machine/place';
import { StockCutter, type Cutter, type StockTool } from './stock_cutter';
import { isGoodTool } from './tool_file';

type Shapes = Record<string, StockTool>;
const isShapes = (value: unknown): value is Shapes =>
  typeof value === 'object' && value !== null && Object.values(value as Shapes).every((one) => typeof one === 'object' && one !== null && isGoodTool(one));

export const showsStock = signal(false);
// What somebody has said of tools, by their numbers. 0: the tool of programs that put none in.
export const toolShapes = kept<Shapes>('stock-tools', {}, isShapes);
export const stockState = signal<'none' | 'loading' | 'there' | 'missing'>('none');
let cutter: StockCutter | null = null;

const usual: StockTool = { kind: 'flat', diameter: 3, angle: 60, tip: 0 };
const noTool: readonly UsedTool[] = [{ tool: 0, diameter: null, zero_z: 0, feeds: true }];

// Those of the shown program.
export const usedTools = computed<readonly UsedTool[]>(() => {
  const used = pathIndex.value?.tools ?? [];
  return used.length === 0 ? noTool : used;
});
// What somebody has said counts, then the diameter of the machine's tool table.
export function shapeOf(used: UsedTool): StockTool {
  return toolShapes.value[used.tool] ?? { ...usual, diameter: used.diameter ?? usual.diameter };
}
export const cutters = computed<readonly Cutter[]>(() => {
  const zero = workOffset.value.z ?? 0;
  return usedTools.value.map((used) => ({ shape: shapeOf(used), length: pathIndex.value === null ? 0 : used.zero_z - zero }));
});

export async function showStock(shows: boolean): Promise<void> {
  showsStock.value = shows;
  if (!shows || stockState.value === 'there' || stockState.value === 'loading') return;
  stockState.value = 'loading';
  try {
    cutter = new StockCutter(await loadModule('stock.wasm'));
    stockState.value = 'there';
  } catch {
    stockState.value = 'missing';
  }
}
export const stockCutter = computed(() => (showsStock.value && stockState.value === 'there' ? cutter : null));
