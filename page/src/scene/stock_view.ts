// Whether the scene shows the stock, and by which tool it is cut. The module comes when somebody wants to see it.
import { computed, signal } from '@preact/signals';
import { kept } from '../core/kept';
import { loadModule } from '../core/wasm';
import { StockCutter, type StockTool } from './stock_cutter';

const isTool = (value: unknown): value is StockTool => typeof value === 'object' && value !== null && 'kind' in value && 'diameter' in value;
export const showsStock = signal(false);
export const stockTool = kept<StockTool>('stock-tool', { kind: 'flat', diameter: 3, angle: 60 }, isTool);
export const stockState = signal<'none' | 'loading' | 'there' | 'missing'>('none');
let cutter: StockCutter | null = null;

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
