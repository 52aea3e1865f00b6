// The scene with its buttons.
import { useEffect, useRef, useState } from 'preact/hooks';
import { say } from '../core/language';
import { pathLoaded } from '../machine/path_index';
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
    <div class="scene">
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
      </div>
      {pathLoaded.value < 1 && <p class="scene-loading">{say('scene.loading', { percent: Math.floor(pathLoaded.value * 100) })}</p>}
    </div>
  );
}
