// Reads a file of tools, as `passo simulate --tool-table` does: a table [tool.N] for each, with its shape and sizes in mm.
import type { StockTool, ToolKind } from './stock_cutter';

const kindNames: readonly string[] = ['flat', 'ball', 'vee', 'bull', 'taper'];

// Empty: the file has no tool that the scene knows.
export function readToolFile(text: string): Record<string, StockTool> {
  const tools: Record<string, StockTool> = {};
  let values: Record<string, string> = {};
  const take = (number: string): void => {
    const size = (key: string, usual: number): number => (values[key] === undefined ? usual : Number(values[key]));
    const shape = (values.shape ?? '').replace(/["']/g, '');
    // A drill cuts as a cone with its point angle.
    const isDrill = shape === 'drill';
    const kind = isDrill ? 'vee' : shape;
    const tool: StockTool = {
      kind: kind as ToolKind,
      diameter: size('diameter_mm', NaN),
      angle: size('angle_deg', isDrill ? 118 : 60),
      tip: kind === 'bull' ? size('corner_radius_mm', NaN) : size('tip_diameter_mm', 0),
    };
    if (kindNames.includes(kind) && isGoodTool(tool)) tools[number] = tool;
  };
  let number = '';
  for (const line of text.split(/\r?\n/)) {
    const bare = line.replace(/("[^"]*"|'[^']*')|#.*$/g, '$1').trim();
    const table = /^\[\s*tool\s*\.\s*(\d+)\s*\]$/.exec(bare);
    if (bare.startsWith('[')) {
      if (number !== '') take(number);
      number = table?.[1] ?? '';
      values = {};
      continue;
    }
    const pair = /^([A-Za-z_]+)\s*=\s*(.+)$/.exec(bare);
    if (pair !== null) values[pair[1]!] = pair[2]!;
  }
  if (number !== '') take(number);
  return tools;
}

export function isGoodTool(tool: StockTool): boolean {
  const { kind, diameter, angle, tip } = tool;
  if (!(diameter >= 0.01 && diameter <= 500)) return false;
  if (kind === 'bull') return tip > 0 && tip < diameter / 2;
  if (kind === 'flat' || kind === 'ball') return true;
  const least = kind === 'taper' ? 1e-6 : 0;
  return angle >= 0.5 && angle <= 179.5 && tip >= least && (kind === 'taper' ? tip <= diameter : tip < diameter);
}
