// Inputs and outputs: each pin live on a picture of the board, the last seconds as a strip, and outputs by hand.
import { signal } from '@preact/signals';
import { useEffect, useRef, useState } from 'preact/hooks';
import { language, say } from '../core/language';
import { letterScale } from '../core/letters';
import { confirm } from '../core/question';
import { theme, themeColour } from '../core/theme';
import { whyUnable } from '../machine/abilities';
import { moveAs, whyNoJob, whyNot } from '../machine/actions';
import { machine, status } from '../machine/connection';
import { changedAt, isOn, levelOf, pins, samples, shownFor, type Pin, type Sample } from '../machine/pins';
import { endSetUp, isSetUp, setUp, type Turn } from '../machine/set_up_mode';
import { Button } from '../parts/button';
import { PulseStrip } from '../parts/pulse_strip';
import { Typed } from '../parts/typed';

const nameOf = (pin: Pin): string => {
  if (pin.name !== 'limit') return say(`pin.${pin.name}` as Parameters<typeof say>[0]);
  const axes = pin.axes.length === 0 ? '' : ` (${pin.axes.map((axis) => axis.toUpperCase()).join(', ')})`;
  return `${say('pin.limit', { number: pin.number + 1 })}${axes}`;
};

const rowHeight = 34;

// Inputs on the left of the board, outputs on its right, motors below them.
function BoardPicture() {
  const now = status.value;
  const known = machine.value;
  if (now === null || known === null) return null;
  const inputs = pins.value.filter((pin) => pin.kind === 'input');
  const outputs = pins.value.filter((pin) => pin.kind === 'output');
  const rows = Math.max(inputs.length, outputs.length + known.motors.length);
  const height = rows * rowHeight + 40;
  const turn = directions();
  return (
    <svg class="board" viewBox={`0 0 640 ${height}`} role="img" aria-label={say('pin.board')}>
      <rect class="board-plate" x="220" y="8" width="200" height={height - 16} rx="14" />
      <text class="board-name" x="320" y={height / 2} text-anchor="middle">
        {known.name}
      </text>
      {[...inputs, ...outputs].map((pin, i) => {
        const left = pin.kind === 'input';
        const y = 38 + (left ? i : i - inputs.length) * rowHeight;
        const on = isOn(pin, now);
        return (
          <g key={pin.id} class={on ? 'on' : ''} data-pin={pin.id}>
            <line x1={left ? 206 : 420} y1={y} x2={left ? 220 : 434} y2={y} />
            <circle cx={left ? 198 : 442} cy={y} r="8" />
            {on && <path d={`M${(left ? 198 : 442) - 4} ${y}l3 3l5 -6`} />}
            <text x={left ? 180 : 460} y={y + 5} text-anchor={left ? 'end' : 'start'}>
              {nameOf(pin)}
            </text>
          </g>
        );
      })}
      {known.motors.map((motor, i) => {
        const y = 38 + (outputs.length + i) * rowHeight;
        const way = turn[i] ?? 0;
        return (
          <g key={`motor ${i}`} class={way !== 0 ? 'on' : ''}>
            <line x1={420} y1={y} x2={434} y2={y} />
            <circle cx="442" cy={y} r="8" />
            <text x="460" y={y + 5}>
              {say('pin.motor', { number: i + 1, axis: motor.axis.toUpperCase() })} {way === 0 ? '' : way > 0 ? '↻ +' : '↺ −'}
            </text>
          </g>
        );
      })}
    </svg>
  );
}

// Which way each motor has just turned.
function directions(): number[] {
  const [before, now] = samples.value.slice(-2);
  const fresh = now !== undefined && performance.now() - now.at < 400;
  if (before === undefined || !fresh) return [];
  return now.steps.map((steps, i) => Math.sign(steps - (before.steps[i] ?? steps)));
}

function PinTable() {
  const now = status.value;
  if (now === null) return null;
  const hasLevels = whyUnable('step-counts') === ''; // a Grbl board tells only which inputs are on
  return (
    <div class="wide-table" tabIndex={0} role="region" aria-label={say('page.pins')}>
      <table class="pins">
        <thead>
          <tr>
            <th scope="col">{say('pin.name')}</th>
            <th scope="col">{say('pin.state')}</th>
            {hasLevels && <th scope="col">{say('pin.level')}</th>}
            {hasLevels && <th scope="col">{say('pin.polarity')}</th>}
            <th scope="col">{say('pin.changed')}</th>
          </tr>
        </thead>
        <tbody>
          {pins.value.map((pin) => {
            const on = isOn(pin, now);
            const changed = changedAt.value[pin.id];
            return (
              <tr key={pin.id} class={on ? 'on' : ''}>
                <th scope="row">{nameOf(pin)}</th>
                <td data-testid={`pin-${pin.id}`}>{say(on ? 'pin.on' : 'pin.off')}</td>
                {hasLevels && <td>{say(levelOf(pin, on) === 'high' ? 'pin.high' : 'pin.low')}</td>}
                {hasLevels && <td>{say(pin.onAt === 'high' ? 'pin.on.high' : 'pin.on.low')}</td>}
                <td>{changed === undefined ? '–' : new Date(changed).toLocaleTimeString(language.value)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}

const speed = signal(1000);

async function begin(): Promise<void> {
  const yes = await confirm({
    title: say('outputs.ask'),
    facts: [say('outputs.facts'), say('outputs.ends')],
    yes: say('outputs.begin'),
    kind: 'go',
  });
  if (yes) await setUp();
}

async function turnSpindle(turn: Turn): Promise<void> {
  if (turn !== 'off') {
    const yes = await confirm({
      title: say('outputs.spindle.ask', { speed: speed.value }),
      facts: [say('outputs.spindle.facts')],
      yes: say('outputs.spindle.on'),
      kind: 'go',
    });
    if (!yes) return;
  }
  await setUp(turn, speed.value);
}

function Outputs() {
  const now = status.value;
  const known = machine.value;
  if (now === null || known === null) return null;
  const why = isSetUp.value ? whyNot('Hold') : say('outputs.only');
  const { outputs } = now;
  const most = known.highest_rpm > 0 ? known.highest_rpm : 1;
  return (
    <section class="panel" aria-label={say('outputs.title')}>
      <h2>{say('outputs.title')}</h2>
      <p class="row">
        {isSetUp.value ? (
          <>
            <b role="status">{say('outputs.now')}</b>
            <Button kind="stop" icon="stop" onClick={endSetUp}>
              {say('outputs.end')}
            </Button>
          </>
        ) : (
          <Button kind="accent" icon="pins" why={whyNoJob.value} onClick={begin}>
            {say('outputs.begin')} …
          </Button>
        )}
      </p>
      <div class="row outputs">
        <Button pressed={outputs.flood} why={why} onClick={() => moveAs('/outputs', { flood: !outputs.flood })}>
          {say('run.flood')}
        </Button>
        <Button pressed={outputs.mist} why={why} onClick={() => moveAs('/outputs', { mist: !outputs.mist })}>
          {say('run.mist')}
        </Button>
        {known.highest_rpm > 0 && (
          <label>
            <span class="dim">
              {say('run.spindle')}, {say('run.rpm')}
            </span>{' '}
            <Typed
              inputMode="numeric"
              value={String(speed.value)}
              take={(typed) => (speed.value = Math.min(most, Math.max(1, Math.round(Number(typed) || 1))))}
            />
          </label>
        )}
        {(['clockwise', 'counterclockwise', 'off'] as const).map((turn) => (
          <Button key={turn} pressed={outputs.spindle === turn} why={why} onClick={() => turnSpindle(turn)}>
            {say('run.spindle')} {say(`run.spindle.${turn}`)}
          </Button>
        ))}
      </div>
      <p class="dim">{say('outputs.ends')}</p>
    </section>
  );
}

// Which rows the strip has: the pins, and then each motor's steps a second, upwards in its positive direction.
function drawStrip(canvas: HTMLCanvasElement, all: readonly Sample[], names: readonly string[], motors: number): void {
  const scale = letterScale();
  const density = window.devicePixelRatio * scale;
  const rows = names.length;
  const row = 24;
  canvas.style.height = `${rows * row * scale}px`;
  canvas.width = Math.max(1, Math.round(canvas.clientWidth * window.devicePixelRatio));
  canvas.height = Math.max(1, Math.round(rows * row * density));
  const pen = canvas.getContext('2d');
  if (pen === null) return;
  pen.scale(density, density);
  const width = canvas.clientWidth / scale;
  const label = Math.min(150, width * 0.35);
  const now = performance.now();
  const x = (at: number): number => label + Math.max(0, 1 - (now - at) / shownFor) * (width - label - 4);
  pen.font = `13px ${getComputedStyle(canvas).fontFamily}`;
  pen.textBaseline = 'middle';
  const pinRows = rows - motors;
  for (let i = 0; i < rows; ++i) {
    const top = i * row + 4;
    const low = top + row - 8;
    pen.strokeStyle = themeColour('--line');
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(0, i * row + row - 0.5);
    pen.lineTo(width, i * row + row - 0.5);
    pen.stroke();
    pen.fillStyle = themeColour('--text');
    pen.fillText(names[i] ?? '', 4, i * row + row / 2, label - 10);
    pen.strokeStyle = themeColour(i < pinRows ? '--accent' : '--y');
    pen.lineWidth = 1.6;
    pen.beginPath();
    const rates = i < pinRows ? [] : ratesOf(all, i - pinRows);
    const most = Math.max(1, ...rates.map((one) => Math.abs(one)));
    all.forEach((sample, k) => {
      const y =
        i < pinRows ? (sample.on[i] === true ? top : low) : (top + low) / 2 - ((rates[k] ?? 0) / most) * ((low - top) / 2);
      const end = all[k + 1]?.at ?? now;
      if (k === 0) pen.moveTo(x(sample.at), y);
      else pen.lineTo(x(sample.at), y);
      pen.lineTo(x(end), y);
    });
    pen.stroke();
  }
}

// Steps a second from each look to the next one.
function ratesOf(all: readonly Sample[], motor: number): number[] {
  return all.map((sample, k) => {
    const next = all[k + 1];
    if (next === undefined) return 0;
    const seconds = (next.at - sample.at) / 1000;
    return seconds > 0.5 ? 0 : ((next.steps[motor] ?? 0) - (sample.steps[motor] ?? 0)) / Math.max(seconds, 0.001);
  });
}

function Strip() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [stands, setStands] = useState(false);
  useEffect(() => {
    if (stands) return undefined;
    const draw = (): void => {
      if (canvas.current === null || document.hidden) return;
      const motors = machine.value?.motors ?? [];
      const names = [...pins.value.map(nameOf), ...motors.map((one, i) => say('pin.motor', { number: i + 1, axis: one.axis.toUpperCase() }))];
      drawStrip(canvas.current, samples.value, names, motors.length);
    };
    draw();
    const timer = setInterval(draw, 100);
    return () => clearInterval(timer);
  }, [stands, language.value, theme.value]);
  return (
    <section class="panel" aria-label={say('strip.title')}>
      <div class="position-head">
        <h2>{say('strip.title')}</h2>
        <Button pressed={stands} icon="hold" onClick={() => setStands(!stands)}>
          {say('strip.stand')}
        </Button>
      </div>
      <canvas class="strip" ref={canvas} role="img" aria-label={say('strip.title')} />
      <p class="dim">{say('strip.what')}</p>
    </section>
  );
}

export function PinsPage() {
  const unable = whyUnable('pulses');
  return (
    <div class="pins-page">
      <div class="pins-side">
        <section class="panel" aria-label={say('pin.board')}>
          <h2>{say('pin.board')}</h2>
          <BoardPicture />
        </section>
        <Outputs />
      </div>
      <div class="pins-side">
        <div class="panel">
          <PinTable />
        </div>
        <Strip />
      </div>
      {unable === '' ? <PulseStrip /> : <p class="dim">{unable}</p>}
    </div>
  );
}
