// The lab: interpolators, motors, ramps, torque and loops, live. Nothing here asks or moves the machine.
import './lab.css';
import type { ComponentChildren, JSX } from 'preact';
import { useEffect, useState } from 'preact/hooks';
import { BoardLab } from './board/BoardLab';
import { DriverLab } from './driver/DriverLab';
import { LoopLab } from './LoopLab';
import { RampsLab } from './RampsLab';
import { arrivals, change, core, coreFailed, followAddress, linkToView, loadCore, refused, view } from './state';
import { StepsLab } from './steps/StepsLab';
import { TorqueLab } from './TorqueLab';
import { parts } from './view';
import { say } from './words';

interface LabPageProps {
  embedded?: boolean; // in a page of someone else: only the part that its link names
  share?: ComponentChildren; // beside the button that copies the link
  children?: ComponentChildren; // below the part
}
export function LabPage({ embedded = false, share, children }: LabPageProps): JSX.Element {
  useEffect(followAddress, []);
  useEffect(() => void loadCore(), []);
  const loaded = core.value;
  const part = view.value.part;
  return (
    <div class="lab">
      {embedded ? (
        <h1 class="unseen">{`${say('lab')}: ${say(`part_${part}`)}`}</h1>
      ) : (
        <header class="lab-head">
          <h1>{say('lab')}</h1>
          <p>{say('labLesson')}</p>
          <CopyLink />
          {share}
        </header>
      )}
      {refused.value.map(({ name, text, expects }) => (
        <p key={name} class="lab-refused" role="status">{say('outOfRange', { value: `${name}=${text}`, expects })}</p>
      ))}
      {!embedded && <Tabs />}
      <div id="lab-part" {...(embedded ? {} : { role: 'tabpanel', 'aria-labelledby': `lab-tab-${part}` })}>
        {!loaded && <p class="lab-lesson" role="status">{say(coreFailed.value ? 'noCore' : 'loading')}</p>}
        {loaded && part === 'steps' && <StepsLab core={loaded} />}
        {loaded && part === 'ramps' && <RampsLab core={loaded} />}
        {loaded && part === 'torque' && <TorqueLab core={loaded} />}
        {loaded && part === 'loop' && <LoopLab core={loaded} />}
        {loaded && part === 'board' && <BoardLab key={arrivals.value} core={loaded} />}
        {loaded && part === 'driver' && <DriverLab core={loaded} />}
      </div>
      {children}
    </div>
  );
}

function Tabs(): JSX.Element {
  const part = view.value.part;
  return (
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
  );
}

const answerFor = 4000; // ms

// The address is the view. Where the browser has no clipboard (no TLS, not this computer), the words say so.
function CopyLink(): JSX.Element {
  const [answer, setAnswer] = useState<'copied' | 'notCopied' | undefined>(undefined);
  useEffect(() => {
    if (answer === undefined) return;
    const timer = setTimeout(() => setAnswer(undefined), answerFor);
    return () => clearTimeout(timer);
  }, [answer]);
  const copy = async (): Promise<void> => {
    try {
      await navigator.clipboard.writeText(linkToView());
      setAnswer('copied');
    } catch {
      setAnswer('notCopied');
    }
  };
  return (
    <span class="lab-copy">
      <span role="status">{answer === undefined ? '' : say(answer)}</span>
      <button type="button" class="button" onClick={() => void copy()}>
        {say('copyLink')}
      </button>
    </span>
  );
}
