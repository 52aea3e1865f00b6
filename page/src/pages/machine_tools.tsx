// The tools of the machine, as a table: what each has cut of its life, its length and its pocket.
import { useEffect } from 'preact/hooks';
import { language, say } from '../core/language';
import { momentText } from '../core/time';
import { lengthText, lengthUnit } from '../core/units';
import { whyNotOurs } from '../machine/actions';
import { isLive } from '../machine/connection';
import { cutWords, machineTools, refreshTools, replaceTool, timeWords, usedShare, type MachineTool } from '../machine/tool_life';
import { Button } from '../parts/button';

const betweenLooks = 2000; // ms, while a job may be cutting

export function ToolsPart() {
  useEffect(() => {
    const look = (): void => {
      if (isLive.value) void refreshTools();
    };
    look();
    const timer = setInterval(look, betweenLooks);
    return () => clearInterval(timer);
  }, []);
  const known = machineTools.value;
  if (known === null) return <p class="dim">{say('frame.loading')}</p>;
  return (
    <section class="panel" aria-label={say('toollife.title')}>
      <h2>{say('toollife.title')}</h2>
      {!known.counts && <p>{say('toollife.nothing')}</p>}
      {known.tools.length === 0 ? <p class="dim">{say('toollife.none')}</p> : <ToolsTable tools={known.tools} counts={known.counts} />}
      <p class="dim">{say('toollife.what')}</p>
    </section>
  );
}

function ToolsTable({ tools, counts }: { tools: MachineTool[]; counts: boolean }) {
  const heads = [
    say('toollife.number'), say('toollife.name'), say('toollife.cut'), say('toollife.time'), say('toollife.used'),
    `${say('toollife.length')}, ${lengthUnit()}`, say('toollife.pocket'), say('toollife.replaced'),
  ];
  return (
    <div class="wide-table" tabIndex={0} role="region" aria-label={say('toollife.title')}>
      <table>
        <thead>
          <tr>
            {heads.map((head, i) => (
              <th scope="col" key={head} class={i === 1 ? 'words' : ''}>
                {head}
              </th>
            ))}
            <th />
          </tr>
        </thead>
        <tbody>
          {tools.map((tool) => (
            <ToolRow key={tool.number} tool={tool} counts={counts} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function ToolRow({ tool, counts }: { tool: MachineTool; counts: boolean }) {
  const used = usedShare(tool);
  return (
    <tr class={used !== null && used >= 1 ? 'refusal' : ''}>
      <th scope="row">T{tool.number}</th>
      <td class="words">{tool.name}</td>
      <td>{cutWords(tool)}</td>
      <td>{timeWords(tool)}</td>
      <td>{used === null ? '–' : `${Math.round(used * 100)} %`}</td>
      <td>{tool.length_mm === null ? '–' : lengthText(tool.length_mm, 3)}</td>
      <td>{tool.pocket ?? '–'}</td>
      <td>{tool.replaced_at === null ? '–' : momentText(tool.replaced_at, language.value)}</td>
      <td>
        {counts && (
          <Button why={whyNotOurs()} onClick={() => replaceTool(tool)}>
            {say('toollife.new')}
          </Button>
        )}
      </td>
    </tr>
  );
}
