// A logic analyser for the motors: each step, its direction and the currents of the windings, with their true times.
import { useEffect, useRef, useState } from 'preact/hooks';
import { language, say } from '../core/language';
import { letterScale } from '../core/letters';
import { attempt } from '../core/notices';
import { theme, themeColour } from '../core/theme';
import { get } from '../machine/api';
import { isLive, machine } from '../machine/connection';
import type { Values } from '../machine/machine_file';
import { askPulses, longest, pulsesOf, shortest, timeWords, upTo, windingsAt, zoomed, type MotorPulses, type PulseWindow, type Span } from '../machine/pulses';
import { Button } from './button';

const rowHeight = 22;
const rowsAMotor = 4; // step, direction, two windings
const topRow = 22; // the scale of time
const followsEvery = 500; // ms
const usualSpan = 0.02; // s

interface Drawn {
  window: PulseWindow;
  motors: MotorPulses[];
  span: Span;
  cursor: number;
  microsteps: number[];
  names: string[];
}

const labelWidth = (width: number): number => Math.min(170, width * 0.34);
const placeOf = ({ span }: Drawn, width: number, at: number): number => labelWidth(width) + ((at - span.from) / (span.to - span.from)) * (width - labelWidth(width) - 2);

// Calls `line` with the row's value before each pulse, at it, and at the end.
function stairs(drawn: Drawn, pulses: MotorPulses, value: (index: number) => number, line: (at: number, value: number) => void): void {
  const first = upTo(pulses.at, drawn.span.from);
  const last = upTo(pulses.at, drawn.span.to);
  let now = value(first - 1);
  line(drawn.span.from, now);
  for (let i = first; i < last; ++i) {
    line(pulses.at[i]!, now);
    now = value(i);
    line(pulses.at[i]!, now);
  }
  line(Math.min(drawn.span.to, drawn.window.end), now);
}

function draw(canvas: HTMLCanvasElement, drawn: Drawn): void {
  const scale = letterScale();
  const density = window.devicePixelRatio * scale;
  const height = topRow + drawn.motors.length * rowsAMotor * rowHeight;
  canvas.style.height = `${height * scale}px`;
  const width = canvas.clientWidth / scale;
  canvas.width = Math.max(1, Math.round(width * density));
  canvas.height = Math.max(1, Math.round(height * density));
  const pen = canvas.getContext('2d');
  if (pen === null) return;
  pen.scale(density, density);
  pen.font = `13px ${getComputedStyle(canvas).fontFamily}`;
  pen.textBaseline = 'middle';
  const x = (at: number): number => placeOf(drawn, width, at);
  drawScale(pen, drawn, width, height);
  drawn.motors.forEach((pulses, motor) => {
    const top = topRow + motor * rowsAMotor * rowHeight;
    const micro = drawn.microsteps[motor] ?? 1;
    const countAt = (i: number): number => (i < 0 ? pulses.before : pulses.counts[i]!);
    const values: ((i: number) => number)[] = [
      () => 0,
      (i) => ((pulses.up[Math.max(0, i)] ?? true) ? 1 : 0),
      (i) => (1 + windingsAt(countAt(i), micro)[0]) / 2,
      (i) => (1 + windingsAt(countAt(i), micro)[1]) / 2,
    ];
    const name = drawn.names[motor] ?? '';
    [name, say('pulses.direction'), say('pulses.winding', { name: 'A' }), say('pulses.winding', { name: 'B' })].forEach((words, row) => {
      const low = top + (row + 1) * rowHeight - 4;
      const high = top + row * rowHeight + 4;
      pen.fillStyle = themeColour(row === 0 ? '--text' : '--dim');
      pen.fillText(words, row === 0 ? 4 : 16, (low + high) / 2, labelWidth(width) - 20);
      pen.strokeStyle = themeColour(row < 2 ? '--accent' : '--y');
      pen.lineWidth = 1.5;
      pen.setLineDash(row === 3 ? [4, 2] : []);
      pen.beginPath();
      if (row === 0) {
        for (let i = upTo(pulses.at, drawn.span.from); i < upTo(pulses.at, drawn.span.to); ++i) {
          pen.moveTo(x(pulses.at[i]!), low);
          pen.lineTo(x(pulses.at[i]!), high);
        }
        pen.moveTo(x(drawn.span.from), low);
        pen.lineTo(x(Math.min(drawn.span.to, drawn.window.end)), low);
      } else {
        let begun = false;
        stairs(drawn, pulses, values[row]!, (at, value) => {
          const y = low - value * (low - high);
          if (begun) pen.lineTo(x(at), y);
          else pen.moveTo(x(at), y);
          begun = true;
        });
      }
      pen.stroke();
      pen.setLineDash([]);
    });
    pen.fillStyle = themeColour('--line');
    pen.fillRect(0, top + rowsAMotor * rowHeight - 1, width, 1);
  });
}

// Times from the left edge, and the cursor.
function drawScale(pen: CanvasRenderingContext2D, drawn: Drawn, width: number, height: number): void {
  const { span } = drawn;
  const wide = span.to - span.from;
  const rough = wide / Math.max(2, (width - labelWidth(width)) / 110);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((one) => one * power >= rough) ?? 10);
  pen.textAlign = 'center';
  for (let i = 1; i * step < wide; ++i) {
    const at = placeOf(drawn, width, span.from + i * step);
    pen.fillStyle = themeColour('--line');
    pen.fillRect(at, topRow, 1, height - topRow);
    pen.fillStyle = themeColour('--dim');
    if (at < width - 40) pen.fillText(`+${timeWords(i * step)}`, at, topRow / 2);
  }
  pen.textAlign = 'start';
  if (drawn.cursor < span.from || drawn.cursor > span.to) return;
  pen.fillStyle = themeColour('--tool');
  pen.fillRect(placeOf(drawn, width, drawn.cursor) - 0.5, topRow, 1.5, height - topRow);
}

// What the file of the machine says; one direct scale says nothing of microsteps.
async function microstepsOf(axes: readonly string[]): Promise<number[]> {
  const { values } = await get<{ values: Values }>('/machine/file');
  return axes.map((axis) => Number(values[`axis.${axis.toUpperCase()}.microsteps`] ?? values[`axis.${axis}.microsteps`] ?? 1) || 1);
}

export function PulseStrip() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [window_, setWindow] = useState<PulseWindow | null>(null);
  const [span, setSpan] = useState<Span>({ from: 0, to: usualSpan });
  const [cursor, setCursor] = useState(0);
  const [follows, setFollows] = useState(false);
  const [microsteps, setMicrosteps] = useState<number[]>([]);
  const motors = machine.value?.motors ?? [];
  const known = machine.value !== null;
  const asked = useRef(0);

  // A margin on both sides, so that the next pan finds something.
  const load = (wanted?: Span): void => {
    const mine = ++asked.current;
    void attempt(async () => {
      const wide = wanted === undefined ? 0 : wanted.to - wanted.from;
      const got = await (wanted === undefined ? askPulses() : askPulses(Math.max(0, wanted.from - wide), wanted.to + wide));
      if (mine !== asked.current) return;
      setWindow(got);
      if (wanted !== undefined) return setSpan(wanted);
      // The last motion, and not the rest after it.
      const end = got.newest;
      setSpan((before) => ({ from: Math.max(got.oldest, end - Math.min(0.1, before.to - before.from)), to: end }));
      setCursor(end);
    });
  };
  const show = (next: Span): void => {
    setFollows(false);
    setSpan(next);
    load(next);
  };
  useEffect(() => {
    if (!isLive.value || !known) return;
    load();
    void attempt(async () => setMicrosteps(await microstepsOf(motors.map((one) => one.axis))));
  }, [isLive.value, known]);
  useEffect(() => {
    if (!follows) return undefined;
    const timer = setInterval(() => {
      if (isLive.value && !document.hidden) load();
    }, followsEvery);
    return () => clearInterval(timer);
  }, [follows]);

  const names = motors.map((one, i) => say('pulses.step', { number: i + 1, axis: one.axis.toUpperCase() }));
  const drawn: Drawn | null =
    window_ === null ? null : { window: window_, motors: motors.map((_, i) => pulsesOf(window_, i)), span, cursor, microsteps, names };
  useEffect(() => {
    if (canvas.current !== null && drawn !== null) draw(canvas.current, drawn);
  }, [window_, span, cursor, microsteps, language.value, theme.value]);

  const middle = (span.from + span.to) / 2;
  const zoom = (factor: number, about = middle): void => show(zoomed(span, factor, about));
  const pan = (share: number): void => {
    const by = share * (span.to - span.from);
    show({ from: span.from + by, to: span.to + by });
  };
  // To the next pulse of any motor.
  const step = (way: 1 | -1): void => {
    if (window_ === null) return;
    const all = Array.from(window_.times, (at) => window_.begin + at);
    const i = way > 0 ? upTo(all, cursor + 1e-9) : upTo(all, cursor - 1e-9) - 1;
    const to = all[i];
    if (to === undefined) return;
    setCursor(to);
    const by = to < span.from || to > span.to ? to - middle : 0;
    if (by !== 0) show({ from: span.from + by, to: span.to + by });
  };
  return (
    <section class="panel pulse-panel" aria-label={say('pulses.title')}>
      <div class="position-head">
        <h2>{say('pulses.title')}</h2>
        <Button pressed={follows} icon="run" why={isLive.value ? '' : say('why.lost')} onClick={() => setFollows(!follows)}>
          {say('pulses.follow')}
        </Button>
      </div>
      <div class="row">
        <Button icon="reset" why={isLive.value ? '' : say('why.lost')} onClick={() => load()}>
          {say('pulses.newest')}
        </Button>
        <Button icon="plus" label={say('pulses.nearer')} why={span.to - span.from <= shortest * 1.01 ? say('pulses.end') : ''} onClick={() => zoom(0.4)} />
        <Button icon="minus" label={say('pulses.wider')} why={span.to - span.from >= longest * 0.99 ? say('pulses.end') : ''} onClick={() => zoom(2.5)} />
        <Button label={say('pulses.earlier')} onClick={() => pan(-0.5)}>
          ◀
        </Button>
        <Button label={say('pulses.later')} onClick={() => pan(0.5)}>
          ▶
        </Button>
        <Button label={say('pulses.before')} onClick={() => step(-1)}>
          ⇤
        </Button>
        <Button label={say('pulses.next')} onClick={() => step(1)}>
          ⇥
        </Button>
      </div>
      <Picture canvas={canvas} span={span} pan={pan} zoom={zoom} setCursor={setCursor} />
      <p role="status" data-testid="pulses">
        {drawn === null || drawn.window.newest <= drawn.window.oldest ? say('pulses.none') : <Reading drawn={drawn} />}
      </p>
      <p class="dim">{say('pulses.what')}</p>
    </section>
  );
}

interface PictureProps {
  canvas: { current: HTMLCanvasElement | null };
  span: Span;
  pan: (share: number) => void;
  zoom: (factor: number, about?: number) => void;
  setCursor: (at: number) => void;
}

// Drag to pan, wheel to zoom, a click puts the cursor.
function Picture({ canvas, span, pan, zoom, setCursor }: PictureProps) {
  const held = useRef<{ x: number; moved: boolean } | null>(null);
  const shareAt = (event: MouseEvent): number => {
    const box = canvas.current!.getBoundingClientRect();
    const width = box.width / letterScale();
    const label = labelWidth(width);
    return ((event.clientX - box.left) / letterScale() - label) / Math.max(1, width - label - 2);
  };
  const timeAt = (event: MouseEvent): number => span.from + shareAt(event) * (span.to - span.from);
  return (
    <canvas
      class="strip pulses"
      ref={canvas}
      role="img"
      aria-label={say('pulses.title')}
      onPointerDown={(event) => {
        held.current = { x: shareAt(event), moved: false };
        event.currentTarget.setPointerCapture(event.pointerId);
      }}
      onPointerMove={(event) => {
        if (held.current !== null && Math.abs(shareAt(event) - held.current.x) > 0.02) held.current.moved = true;
      }}
      onPointerUp={(event) => {
        const now = held.current;
        held.current = null;
        if (now === null) return;
        if (now.moved) pan(now.x - shareAt(event));
        else if (shareAt(event) >= 0) setCursor(timeAt(event));
      }}
      onWheel={(event) => {
        if (!event.ctrlKey && !event.shiftKey) return; // the page scrolls
        event.preventDefault();
        zoom(event.deltaY > 0 ? 1.5 : 1 / 1.5, timeAt(event));
      }}
    />
  );
}

// The time of the cursor, and for each motor that steps: its count, and how long it is since the pulse before.
function Reading({ drawn }: { drawn: Drawn }) {
  const { cursor, window: { begin, end, oldest, newest }, span } = drawn;
  const cut = end < Math.min(span.to, newest) - 1e-9;
  const of = drawn.motors.map((pulses, motor) => {
    const i = upTo(pulses.at, cursor + 1e-9) - 1;
    const count = i < 0 ? pulses.before : pulses.counts[i]!;
    const axis = machine.value?.motors[motor]?.axis.toUpperCase() ?? '';
    if (i < 1) return `${axis} ${count}`;
    const interval = pulses.at[i]! - pulses.at[i - 1]!;
    return say('pulses.motor', { axis, count, interval: timeWords(interval), rate: Math.round(1 / interval).toLocaleString(language.value) });
  });
  return (
    <>
      <b>{say('pulses.at', { at: (cursor - oldest).toFixed(6), wide: timeWords(span.to - span.from) })}</b> {of.join(' · ')}
      {cut && <> {say('pulses.many', { shown: timeWords(Math.max(0, end - Math.max(begin, span.from))) })}</>}
    </>
  );
}
