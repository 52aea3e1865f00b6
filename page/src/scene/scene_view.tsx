// The scene with its buttons.
import { useEffect, useRef, useState } from 'preact/hooks';
import { say } from '../core/language';
import { status } from '../machine/connection';
import { lengthText, lengthUnit, speedText, speedUnit } from '../core/units';
import { pathIndex, pathLoaded } from '../machine/path_index';
import { workOffset } from '../machine/place';
import { isUnderWay } from '../machine/words';
import { PickedLine } from '../parts/picked_line';
import { colouring, section, sectionShare, tells } from './colouring';
import { followsTool, picked, showsRapids, Stage } from './stage';

export function SceneView() {
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
    <div class="scene" data-shown={pathLoaded.value === 1 ? (pathIndex.value?.program ?? '') : ''}>
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
        <button type="button" class="chip" aria-pressed={followsTool.value} onClick={() => (followsTool.value = !followsTool.value)}>
          {say('scene.tool')}
        </button>
        <button
          type="button"
          class="chip"
          aria-pressed={sectionShare.value !== null}
          onClick={() => (sectionShare.value = sectionShare.value === null ? 0.5 : null)}
        >
          {say('scene.section')}
        </button>
        <label class="chip">
          <span class="unseen">{say('scene.colour')}</span>
          <select value={tells.value} onChange={(event) => (tells.value = event.currentTarget.value as typeof tells.value)}>
            <option value="nothing">{say('scene.colour.nothing')}</option>
            <option value="speed">{say('scene.colour.speed')}</option>
            <option value="depth">{say('scene.colour.depth')}</option>
          </select>
        </label>
      </div>
      <Section />
      <Legend />
      <div class="narrow-only">{!isUnderWay(status.value?.job ?? null) && <PickedLine />}</div>
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
    <label class="scene-section">
      <span class="unseen">{say('scene.section')}</span>
      <input
        type="range"
        min="0"
        max="1"
        step="0.005"
        value={share}
        onInput={(event) => (sectionShare.value = Number(event.currentTarget.value))}
      />
      <b>{share >= 1 ? say('scene.section.all') : `Z ${lengthText(section.value - zero, 2)} ${lengthUnit()}`}</b>
    </label>
  );
}

// What the colours tell, in figures.
function Legend() {
  const now = colouring.value;
  const speeds = pathIndex.value?.speeds;
  if (now.tells === 'nothing') return null;
  const zero = workOffset.value.z ?? 0;
  const words = (mm: number): string => (now.tells === 'depth' ? `Z ${lengthText(mm - zero, 2)}` : speedText(mm));
  const [low, high] = now.tells === 'depth' ? [now.low, now.high] : [speeds?.low ?? 0, speeds?.high ?? 0];
  return (
    <p class="scene-legend">
      <span>{words(low)}</span> <i /> <span>{words(high)}</span>{' '}
      <span class="unit">{now.tells === 'depth' ? lengthUnit() : speedUnit()}</span>
    </p>
  );
}
