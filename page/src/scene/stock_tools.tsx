// The tools that cut the stock, one for each that the program puts in: from a file of tools, or as somebody says.
import { useState } from 'preact/hooks';
import { reportWords } from '../core/faults';
import { say, sayCount } from '../core/language';
import { attempt } from '../core/notices';
import { fromMm, lengthUnit, toMm } from '../core/units';
import type { UsedTool } from '../machine/path_index';
import type { StockTool, ToolKind } from './stock_cutter';
import { FileChoice } from '../parts/file_choice';
import { Select } from '../parts/select';
import { Typed } from '../parts/typed';
import { shapeOf, showsStock, stockState, toolShapes, usedTools } from './stock_view';
import { isGoodTool, readToolFile } from './tool_file';

const kinds: readonly ToolKind[] = ['flat', 'ball', 'vee', 'bull', 'taper'];
const shown = (mm: number): string => String(Number(fromMm(mm).toFixed(4)));

// What a kind begins with, where the sizes of the one before make no tool.
function asKind(tool: StockTool, kind: ToolKind): StockTool {
  const same = { ...tool, kind };
  if (isGoodTool(same)) return same;
  return { kind, diameter: tool.diameter, angle: kind === 'taper' ? 10 : 60, tip: kind === 'vee' ? 0 : tool.diameter / 4 };
}

function NumberField({ title, value, set }: { title: string; value: string; set: (typed: number) => boolean }) {
  return (
    <label>
      <span>{title}</span>{' '}
      <Typed inputMode="decimal" value={value} take={(typed) => set(Number(typed.trim().replace(',', '.')))} />
    </label>
  );
}

function OneTool({ used }: { used: UsedTool }) {
  const tool = shapeOf(used);
  const set = (to: StockTool): boolean => {
    const good = isGoodTool(to);
    if (good) toolShapes.value = { ...toolShapes.value, [used.tool]: to };
    return good;
  };
  const name = used.tool === 0 ? say('stock.tool') : say('stock.tool.number', { number: used.tool });
  return (
    <div class="scene-tool" role="group" aria-label={name}>
      {used.tool !== 0 && <b>T{used.tool}</b>}
      <label>
        <span class="unseen">{name}</span>
        <Select value={tool.kind} all={kinds.map((one) => [one, say(`stock.${one}`)] as const)} set={(to) => set(asKind(tool, to as ToolKind))} />
      </label>
      <NumberField title={`Ø ${lengthUnit()}`} value={shown(tool.diameter)} set={(typed) => set({ ...tool, diameter: toMm(typed) })} />
      {(tool.kind === 'vee' || tool.kind === 'taper') && <NumberField title="°" value={String(tool.angle)} set={(typed) => set({ ...tool, angle: typed })} />}
      {tool.kind !== 'flat' && tool.kind !== 'ball' && (
        <NumberField title={say(tool.kind === 'bull' ? 'stock.corner' : 'stock.tip')} value={shown(tool.tip)} set={(typed) => set({ ...tool, tip: toMm(typed) })} />
      )}
    </div>
  );
}

export function StockTools() {
  const [said, setSaid] = useState('');
  if (!showsStock.value) return null;
  if (stockState.value === 'missing') return <p class="scene-stock">{say('stock.missing')}</p>;
  const take = async (file: File | undefined): Promise<void> => {
    if (file === undefined) return;
    await attempt(async () => {
      const { tools, findings } = await readToolFile(file);
      toolShapes.value = { ...toolShapes.value, ...tools };
      const count = Object.keys(tools).length;
      const why = findings[0];
      const none = `${say('stock.file.none', { name: file.name })} ${why === undefined ? '' : `${why.line}: ${reportWords(why.message, why.message_sentence)}`}`;
      setSaid(count === 0 ? none : sayCount('stock.file.read', count, { name: file.name }));
    });
  };
  return (
    <div class="scene-stock" role="group" aria-label={say('stock.tools')}>
      {usedTools.value.filter((used) => used.feeds).map((used) => (
        <OneTool key={used.tool} used={used} />
      ))}
      <FileChoice label={say('stock.file')} accept=".toml" take={([one]) => take(one)}>
        {(choose) => (
          <button type="button" class="chip" onClick={choose}>
            {say('stock.file')}
          </button>
        )}
      </FileChoice>
      <span role="status">{said}</span>
    </div>
  );
}
