// A file of tools, read by the server, and which shapes a tool can have.
import type { Finding } from '../machine/api';
import { upload } from '../machine/api';
import type { StockTool } from './stock_cutter';

interface Library {
  tools: (StockTool & { number: number })[];
  findings: Finding[];
}

// By the numbers of the tools. Without tools, the findings tell why.
export async function readToolFile(file: File): Promise<{ tools: Record<string, StockTool>; findings: Finding[] }> {
  const { tools, findings } = await upload<Library>('/tools', file.name, file);
  return { tools: Object.fromEntries(tools.map(({ number, kind, diameter, angle, tip }) => [String(number), { kind, diameter, angle, tip }])), findings };
}

export function isGoodTool(tool: StockTool): boolean {
  const { kind, diameter, angle, tip } = tool;
  if (!(diameter >= 0.01 && diameter <= 500)) return false;
  if (kind === 'bull') return tip > 0 && tip < diameter / 2;
  if (kind === 'flat' || kind === 'ball') return true;
  const least = kind === 'taper' ? 1e-6 : 0;
  return angle >= 0.5 && angle <= 179.5 && tip >= least && (kind === 'taper' ? tip <= diameter : tip < diameter);
}
