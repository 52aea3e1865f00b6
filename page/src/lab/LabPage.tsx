// The lab: interpolators, motors, ramps, torque and loops, live. Nothing here asks or moves the machine.
import './lab.css';
import type { JSX } from 'preact';
import { useEffect } from 'preact/hooks';
import { BoardLab } from './board/BoardLab';
import { DriverLab } from './driver/DriverLab';
import { LoopLab } from './LoopLab';
import { RampsLab } from './RampsLab';
import { change, core, coreFailed, followAddress, loadCore, view } from './state';
import { StepsLab } from './steps/StepsLab';
import { TorqueLab } from './TorqueLab';
import { parts } from './view';
import { say } from './words';

export function LabPage(): JSX.Element {
  useEffect(followAddress, []);
  useEffect(() => void loadCore(), []);
  const loaded = core.value;
  const part = view.value.part;
  return (
    <div class="lab">
      <header class="lab-head">
        <h1>{say('lab')}</h1>
        <p>{say('labLesson')}</p>
        <CopyLink />
      </header>
      <div class="lab-tabs" role="tablist" aria-label={say('lab')}>
        {parts.map((one) => (
          <button
            key={one}
            type="button"
            role="tab"
            id={`lab-tab-${one}`}
            aria-selected={part === one}
            aria-controls="lab-part"
            tabIndex={part === one ? 0 : -1}
            onClick={() => change({ part: one })}
            onKeyDown={(event) => {
              const by = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
              const next = parts[(parts.indexOf(one) + by + parts.length) % parts.length];
              if (by === 0 || !next) return;
              change({ part: next });
              document.getElementById(`lab-tab-${next}`)?.focus();
            }}
          >
            {say(`part_${one}`)}
          </button>
        ))}
      </div>
      <div id="lab-part" role="tabpanel" aria-labelledby={`lab-tab-${part}`}>
        {!loaded && <p class="lab-lesson" role="status">{say(coreFailed.value ? 'noCore' : 'loading')}</p>}
        {loaded && part === 'steps' && <StepsLab core={loaded} />}
        {loaded && part === 'ramps' && <RampsLab core={loaded} />}
        {loaded && part === 'torque' && <TorqueLab core={loaded} />}
        {loaded && part === 'loop' && <LoopLab core={loaded} />}
        {loaded && part === 'board' && <BoardLab core={loaded} />}
        {loaded && part === 'driver' && <DriverLab core={loaded} />}
      </div>
    </div>
  );
}

// The address is the view. Without a clipboard (no TLS, not this computer) it can still be copied from the address line.
function CopyLink(): JSX.Element | null {
  if (typeof navigator === 'undefined' || !('clipboard' in navigator)) return null;
  return (
    <button type="button" class="button lab-copy" onClick={() => void navigator.clipboard.writeText(location.href)}>
      {say('copyLink')}
    </button>
  );
}
