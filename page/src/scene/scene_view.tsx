// The scene with its buttons.
import { useEffect, useRef, useState } from 'preact/hooks';
import { say } from '../core/language';
import { status } from '../machine/connection';
import { lengthText, lengthUnit, speedText, speedUnit } from '../core/units';
import { pathIndex, pathLoaded } from '../machine/path_index';
import { workOffset } from '../machine/place';
import { loadsOfShown, wantLoads } from '../machine/studies';
import { isUnderWay } from '../machine/words';
import { PickedLine } from '../parts/picked_line';
import { Select, type Choices } from '../parts/select';
import { Slider } from '../parts/slider';
import { colouring, section, sectionShare, tells } from './colouring';
import { StockTools } from './stock_tools';
import { showsStock, showStock } from './stock_view';
import { drawnProgram, followsTool, picked, showsRapids, Stage } from './stage';

const colours = (alone: boolean): Choices =>
  (['nothing', 'speed', 'depth', ...(alone ? [] : (['torque'] as const))] as const).map((one) => [one, say(`scene.colour.${one}`)] as const);

// `alone`: the path of a program without a machine: there is no tool to follow, and nothing starts.
export function SceneView({ alone = false }: { alone?: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const labels = useRef<HTMLDivElement>(null);
  const stage = useRef<Stage | null>(null);
  const [works, setWorks] = useState(true);
  useEffect(() => {
    if (canvas.current === null || labels.current === null) return undefined;
    try {
      stage.current = new Stage(canvas.current, labels.current);
    } catch {
      setWorks(false);
    }
    return () => stage.current?.end();
  }, []);
  if (!works) return <p class="scene dim">{say('scene.none')}</p>;
  return (
    <div class="scene" data-shown={drawnProgram.value ?? ''}>
      <canvas ref={canvas} role="img" aria-label={say('scene.title')} title={say('scene.help')} />
      <div class="scene-labels" ref={labels} aria-hidden="true">
        <span data-axis="x">X</span>
        <span data-axis="y">Y</span>
        <span data-axis="z">Z</span>
        <span class="scene-mark">
          <i />
          {picked.value !== null && <b>{say('run.line', { line: picked.value })}</b>}
        </span>
      </div>
      <div class="scene-buttons" role="group" aria-label={say('scene.title')}>
        {(['top', 'front', 'iso'] as const).map((one) => (
          <button type="button" class="chip" key={one} onClick={() => stage.current?.look(one)}>
            {say(`scene.${one}`)}
          </button>
        ))}
        <button type="button" class="chip" aria-pressed={showsRapids.value} onClick={() => (showsRapids.value = !showsRapids.value)}>
          {say('scene.rapids')}
        </button>
        {!alone && (
          <button type="button" class="chip" aria-pressed={followsTool.value} onClick={() => (followsTool.value = !followsTool.value)}>
            {say('scene.tool')}
          </button>
        )}
        <button
          type="button"
          class="chip"
          aria-pressed={sectionShare.value !== null}
          onClick={() => (sectionShare.value = sectionShare.value === null ? 0.5 : null)}
        >
          {say('scene.section')}
        </button>
        {!alone && (
          <button type="button" class="chip" aria-pressed={showsStock.value} onClick={() => showStock(!showsStock.value)}>
            {say('scene.stock')}
          </button>
        )}
        <label class="chip">
          <span class="unseen">{say('scene.colour')}</span>
          <Select value={tells.value} all={colours(alone)} set={(to) => (tells.value = to as typeof tells.value)} />
        </label>
      </div>
      <Section />
      {!alone && <StockTools />}
      <Legend alone={alone} />
      {!alone && <div class="narrow-only">{!isUnderWay(status.value?.job ?? null) && <PickedLine />}</div>}
      {pathLoaded.value < 1 && <p class="scene-loading">{say('scene.loading', { percent: Math.floor(pathLoaded.value * 100) })}</p>}
    </div>
  );
}

// The height of the section, beside the path.
function Section() {
  const share = sectionShare.value;
  if (share === null) return null;
  const zero = workOffset.value.z ?? 0;
  return (
    <Slider
      class="scene-section"
      name={say('scene.section')}
      hidesName
      value={share}
      step={0.005}
      words={share >= 1 ? say('scene.section.all') : `Z ${lengthText(section.value - zero, 2)} ${lengthUnit()}`}
      set={(to) => (sectionShare.value = to)}
    />
  );
}

// The torque is worked out when somebody wants to see it.
function TorqueState() {
  useEffect(wantLoads, []);
  const loads = loadsOfShown.value;
  if (loads?.state === 'done') return null;
  const words = loads === null || loads.state === 'running' ? say('torque.running') : say(`torque.${loads.state}`, { why: loads.words });
  return <p class="scene-legend">{words}</p>;
}

// What the colours tell, in figures.
function Legend({ alone }: { alone: boolean }) {
  const now = colouring.value;
  const speeds = pathIndex.value?.speeds;
  if (!alone && tells.value === 'torque' && now.tells === 'nothing') return <TorqueState />;
  if (now.tells === 'nothing') return null;
  const zero = workOffset.value.z ?? 0;
  const ends: Record<'speed' | 'depth' | 'torque', [string, string, string]> = {
    speed: [speedText(speeds?.low ?? 0), speedText(speeds?.high ?? 0), speedUnit()],
    depth: [`Z ${lengthText(now.low - zero, 2)}`, `Z ${lengthText(now.high - zero, 2)}`, lengthUnit()],
    torque: ['0', '100', `% ${say('torque.unit')}`],
  };
  const [low, high, unit] = ends[now.tells];
  return (
    <p class="scene-legend">
      <span>{low}</span> <i /> <span>{high}</span> <span class="unit">{unit}</span>
    </p>
  );
}
