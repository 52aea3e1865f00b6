// The picture of the machine's camera with a cross-hair, and what the cross-hair is for. Without a camera there is nothing.
import { useEffect, useRef, useState } from 'preact/hooks';
import { say } from '../core/language';
import { whyNoSetUp } from '../machine/actions';
import type { MachineCamera } from '../machine/api';
import {
  cameraWords, goToCrossHair, keepOffset, mark, offsetFrom, showsCamera, streamAddress, turnOf, zeroAtCrossHair, zoom, zooms,
} from '../machine/camera';
import { isLive, machine, status } from '../machine/connection';
import { machinePlace, placeWords } from '../machine/place';
import { Button } from './button';

const retryAfter = 2000; // ms

// Whether anybody can see the page: a hidden tab needs no pictures.
function useVisible(): boolean {
  const [visible, setVisible] = useState(document.visibilityState !== 'hidden');
  useEffect(() => {
    const look = (): void => setVisible(document.visibilityState !== 'hidden');
    document.addEventListener('visibilitychange', look);
    return () => document.removeEventListener('visibilitychange', look);
  }, []);
  return visible;
}

// Browsers go on loading a stream whose element was only removed.
function Stream({ camera }: { camera: MachineCamera }) {
  const image = useRef<HTMLImageElement>(null);
  const [attempt, setAttempt] = useState(0);
  useEffect(() => {
    const shown = image.current;
    return () => shown?.removeAttribute('src');
  }, []);
  return (
    <img
      ref={image}
      src={streamAddress(attempt)}
      alt={say('camera.picture')}
      style={{ transform: turnOf(camera, zoom.value) }}
      onError={() => setTimeout(() => setAttempt((before) => before + 1), retryAfter)}
    />
  );
}

function Picture({ camera }: { camera: MachineCamera }) {
  const visible = useVisible();
  const words = cameraWords(status.value?.camera);
  return (
    <div class={`camera-picture ${camera.rotation % 180 === 0 ? '' : 'upright'}`}>
      {visible && isLive.value && <Stream camera={camera} />}
      <svg class="cross-hair" viewBox="-50 -50 100 100" aria-hidden="true" focusable="false">
        <path d="M-50 0H-3M3 0H50M0 -50V-3M0 3V50" />
        <circle r="12" />
      </svg>
      <p class="camera-state" role="status" data-testid="camera-state">
        {words}
      </p>
    </div>
  );
}

function Zoom() {
  return (
    <div class="camera-zoom" role="group" aria-label={say('camera.zoom')}>
      {zooms.map((times) => (
        <button type="button" class="chip" key={times} aria-pressed={zoom.value === times} onClick={() => (zoom.value = times)}>
          {times}×
        </button>
      ))}
    </div>
  );
}

// Where the camera looks, measured with a dot that the spindle has made.
function OffsetFinder() {
  const marked = mark.value;
  return (
    <details class="camera-offset">
      <summary>{say('camera.offset')}</summary>
      <ol>
        <li>{say('camera.offset.dot')}</li>
        <li>{say('camera.offset.look')}</li>
        <li>{say('camera.offset.read')}</li>
      </ol>
      <Button icon="done" why={isLive.value ? '' : say('why.lost')} onClick={() => (mark.value = machinePlace.value)}>
        {say('camera.offset.mark')}
      </Button>
      {marked !== null && (
        <>
          <p role="status" data-testid="camera-offset">
            {say('camera.offset.now', { place: placeWords(offsetFrom(marked, machinePlace.value)) })}
          </p>
          <Button icon="files" why={whyNoSetUp()} onClick={keepOffset}>
            {say('camera.offset.keep')}
          </Button>
        </>
      )}
    </details>
  );
}

// `sets`: with the search for the offset.
export function CameraView({ sets = false }: { sets?: boolean }) {
  const camera = machine.value?.camera;
  if (!camera) return null;
  const why = whyNoSetUp();
  return (
    <section class="panel camera" aria-label={say('camera.title')}>
      {showsCamera.value && <Picture camera={camera} />}
      <div class="camera-tools">
        <div class="camera-head">
          <button type="button" class="chip" aria-pressed={showsCamera.value} onClick={() => (showsCamera.value = !showsCamera.value)}>
            {say('camera.title')}
          </button>
          {showsCamera.value && <Zoom />}
        </div>
        {showsCamera.value && (
          <>
            <Button icon="zero" why={why} onClick={zeroAtCrossHair}>
              {say('camera.zero')}
            </Button>
            <Button icon="jog" why={why} onClick={goToCrossHair}>
              {say('camera.go')}
            </Button>
            {sets && <OffsetFinder />}
          </>
        )}
      </div>
    </section>
  );
}
