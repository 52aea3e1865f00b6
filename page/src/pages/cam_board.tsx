// A whole board: which layer each file is, for confirmation, and what to do when.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { say, type Key } from '../core/language';
import { goTo } from '../core/route';
import { durationText } from '../core/time';
import { lengthText, lengthUnit } from '../core/units';
import { cam, madeCount, type BoardFile, type BoardReport, type BoardStep } from '../machine/cam';
import { chosen } from '../machine/programs';
import { token } from '../machine/token';
import { Button } from '../parts/button';
import { Select } from '../parts/select';
import { ask, formNow, layers, setLayer } from './cam_order';

const layerNames = ['top copper', 'bottom copper', 'inner copper', 'outline', 'nothing'] as const;
const otherRoles = ['mask', 'paste', 'print', 'drawing'] as const;

// "inner copper 2" is "inner copper"; what nobody knows is nothing.
function layerOf(file: BoardFile): string {
  const said = layers.value[file.name] ?? file.layer;
  return said === 'unknown' ? 'nothing' : said.replace(/ \d+$/, '');
}
function layerWords(layer: string): string {
  const role = otherRoles.find((one) => layer.endsWith(one));
  const known = role ?? layer;
  return say(`cam.layer.${known}` as Key);
}

export function BoardLayers() {
  const report = cam.value?.job === 'board' ? cam.value.report : null;
  // What a person has said of a file counts also where the last order did not know that the file would be there.
  const forgotten = report?.files.some((file) => layers.value[file.name] !== undefined && file.told_by !== 'you') === true;
  useEffect(() => {
    if (forgotten) ask(formNow());
  }, [forgotten]);
  if (report === null) return null;
  return (
    <section class="panel" aria-label={say('cam.board.layers')}>
      <h2>{say('cam.board.layers')}</h2>
      <p class="dim">{say('cam.board.layers.what')}</p>
      <ul class="board-layers">
        {report.files.map((file) => {
          const layer = layerOf(file);
          const choices: string[] = file.drill_file ? ['drill', 'nothing'] : [...layerNames];
          if (!choices.includes(layer)) choices.push(layer);
          return (
            <li key={file.file}>
              <label class="form-field">
                <span class="file-name">{file.name}</span>
                <Select value={layer} all={choices.map((one) => [one, layerWords(one)] as const)} set={(to) => setLayer(file.name, to)} />
              </label>
              <span class="dim">{say(`cam.told.${file.told_by}`)}</span>
            </li>
          );
        })}
      </ul>
      {report.left_out.length > 0 && <p class="dim">{say('cam.board.left', { names: report.left_out.join(', ') })}</p>}
    </section>
  );
}

// What a person does at a step, a sentence each.
function wordsOf(report: BoardReport, step: BoardStep): string[] {
  const length = (mm: number): string => lengthText(mm, 2);
  const turned = report.turn === '' ? [] : [say(`cam.do.turn.${report.turn}`)];
  const size = (of: { across_mm: number; up_mm: number }): string => `${length(of.across_mm)} × ${length(of.up_mm)} ${lengthUnit()}`;
  const places = (report.registration?.holes ?? []).map((hole) => `X${length(hole.x_mm)} Y${length(hole.y_mm)}`);
  const holes = places.length === 2 ? [say('cam.do.holes', { one: places[0] ?? '', two: places[1] ?? '' })] : [];
  switch (step.step) {
    case 'blank':
      return [
        say('cam.do.size', { size: size(report.board) }),
        ...(report.copies === undefined ? [] : [say('cam.do.copies', { count: report.copies.count, size: size(report.copies) })]),
        say(`cam.do.up.${report.up}`),
        say('cam.do.zero', { margin: `${length(report.margin_mm)} ${lengthUnit()}` }),
      ];
    case 'drill':
      return [say('cam.do.drill'), ...(report.holes === 'pins' ? [say('cam.do.pins')] : report.holes === 'probe' ? [say('cam.do.probe.holes')] : [])];
    case 'heights-front':
    case 'heights-back':
      return [say('cam.do.heights'), say('cam.do.level')];
    case 'turn':
      return [...turned, ...(report.holes === 'pins' ? [say('cam.do.pins.in'), ...holes] : [say('cam.do.again')])];
    case 'find-holes':
      return [...turned, say('cam.do.clamp'), say('cam.do.find'), say('cam.do.again')];
    case 'front':
    case 'back':
      return [say('cam.do.cutter'), say('cam.do.run')];
    case 'mask-front':
    case 'mask-back':
      return [say('cam.do.mask')];
    case 'stencil-front':
    case 'stencil-back':
      return [say('cam.do.film'), say('cam.do.tool'), say('cam.do.run')];
    case 'edge':
      return [say('cam.do.tool'), say('cam.do.run'), say('cam.do.tabs')];
    default:
      return [];
  }
}

function Tool({ words }: { words: string }) {
  const known = /^(drill|cutter) ([\d.]+) mm$/.exec(words);
  if (known === null) return <li lang="en">{words}</li>;
  const size = `${Number(lengthText(Number(known[2]), 4))} ${lengthUnit()}`;
  return <li>{say(`cam.tool.is.${known[1] as 'drill' | 'cutter'}`, { size })}</li>;
}

// Which steps somebody has ticked off, of which making.
const done = signal<{ made: number; steps: readonly number[] }>({ made: -1, steps: [] });
const withPicture: readonly string[] = ['blank', 'drill', 'front', 'back', 'mask-front', 'mask-back', 'edge', 'stencil-front', 'stencil-back'];
const secretOf = (): string => (token.value === '' ? '' : `&token=${token.value}`);

function Step({ report, step, at, program, number }: { report: BoardReport; step: BoardStep; at: number; program: number | null; number: number | null }) {
  const ticked = done.value.made === madeCount.value ? done.value.steps : [];
  const title = say(`cam.step.${step.step}`);
  return (
    <li class="board-step">
      <h3>
        <label>
          <input
            type="checkbox"
            aria-label={say('cam.step.done', { number: at + 1 })}
            checked={ticked.includes(at)}
            onChange={(event) => {
              done.value = { made: madeCount.value, steps: event.currentTarget.checked ? [...ticked, at] : ticked.filter((one) => one !== at) };
            }}
          />
          <span>
            {at + 1}. {title}
          </span>
        </label>
        {step.time_s !== null && <span class="dim">{durationText(step.time_s)}</span>}
      </h3>
      <ul>
        {step.tools.map((one) => (
          <Tool key={one} words={one} />
        ))}
      </ul>
      <ol>
        {wordsOf(report, step).map((one) => (
          <li key={one}>{one}</li>
        ))}
      </ol>
      {withPicture.includes(step.step) && (
        <img src={`api/v1/cam/picture?${number === null ? '' : `number=${number}&`}made=${madeCount.value}${secretOf()}`} alt={title} loading="lazy" />
      )}
      {program !== null && (
        <p class="row">
          <Button
            kind="accent"
            icon="run"
            label={`${say('cam.do.open')}: ${step.program}`}
            onClick={() => {
              chosen.value = program;
              goTo('files');
            }}
          >
            {say('cam.do.open')}
          </Button>
          <span class="dim file-name">{step.program}</span>
        </p>
      )}
      {step.figures !== '' && (
        <details>
          <summary>{say('cam.figures')}</summary>
          <pre class="toml" lang="en" tabIndex={0}>
            {step.figures}
          </pre>
        </details>
      )}
    </li>
  );
}

export function BoardSteps() {
  const now = cam.value;
  if (now === null || now.job !== 'board' || now.state !== 'done' || now.report === null) return null;
  const { report } = now;
  let programs = 0;
  return (
    <section class="board-do" aria-label={say('cam.board.do')}>
      <div class="position-head">
        <h2>{say('cam.board.do')}</h2>
        {now.page && (
          <a href={`api/v1/cam/page?made=${madeCount.value}${secretOf()}`} target="_blank" rel="noopener">
            {say('cam.board.page')}
          </a>
        )}
      </div>
      {report.machine !== '' && <p class="dim">{say('cam.board.times')}</p>}
      <ol class="board-steps">
        {report.steps.map((step, at) => {
          const number = step.program === '' ? null : programs++;
          return <Step key={at} report={report} step={step} at={at} number={number} program={number === null ? null : (now.programs[number] ?? null)} />;
        })}
      </ol>
    </section>
  );
}
