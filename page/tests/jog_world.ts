// A false clock, a false browser and a false daemon around the page's own jog code. The daemon moves as the real one does:
// a jog ends with its lease, with a stop, or after its distance, and then brakes for a moment.
import { signal } from '@preact/signals';
import { vi } from 'vitest';
import type { Direction } from '../src/machine/jog';

export const path = signal('jog');
export const connection = signal('live');
export const status = signal<Record<string, unknown> | null>(null);
export const machine = signal({ axes: ['x', 'y', 'z'].map((axis) => ({ axis, speed: 3000 })) });

const brakes = 30; // ms
const each = 33; // ms, between two statuses
const mostDelay = 15; // ms, one way

export class Daemon {
  state = 'Idle';
  changes = 1;
  moves: { direction: Record<string, number>; lasts: boolean } | null = null;
  stepsBegun = 0;
  cut = false; // the network carries nothing
  random: () => number = Math.random;
  private braking = false;
  private leaseEnd = 0;
  private lease = 0;
  private stepEnd = Infinity;
  private heardUntil = 0; // messages of the stream keep their order, both ways
  private toldUntil = 0;

  private delay(): number {
    return this.random() * mostDelay;
  }

  async post(to: string, body: { direction?: Record<string, number>; distance?: number; speed?: number; lease?: number } = {}): Promise<unknown> {
    await this.network();
    if (to === '/jog') {
      if (this.state !== 'Idle') throw new Error('the machine is busy');
      this.moves = { direction: body.direction ?? {}, lasts: (body.distance ?? 0) === 0 };
      this.braking = false;
      this.lease = (body.lease ?? 0.25) * 1000;
      this.leaseEnd = Date.now() + this.lease;
      if (!this.moves.lasts) ++this.stepsBegun;
      this.stepEnd = this.moves.lasts ? Infinity : Date.now() + ((body.distance ?? 0) / (body.speed ?? 600)) * 60_000;
      this.change('Jog');
    }
    if (to === '/stop') this.brake();
    const change = this.changes;
    await this.network();
    return to === '/owner' ? { key: 'key' } : { ticket: 1, change };
  }
  private async network(): Promise<void> {
    const cut = this.cut;
    await new Promise((done) => setTimeout(done, cut ? 5000 : this.delay()));
    if (cut || this.cut) throw new Error('the network is gone');
  }

  tell(to: string): boolean {
    if (connection.value !== 'live') return false;
    if (this.cut) return true; // nobody knows yet
    this.heardUntil = Math.max(Date.now() + this.delay(), this.heardUntil);
    setTimeout(() => {
      if (to === '/stop') this.brake();
      if (to === '/jog/renew' && this.state === 'Jog' && !this.braking) this.leaseEnd = Date.now() + this.lease;
    }, this.heardUntil - Date.now());
    return true;
  }

  private change(state: string): void {
    this.state = state;
    ++this.changes;
  }
  private brake(): void {
    if (this.moves === null || this.braking) return;
    this.braking = true;
    setTimeout(() => {
      this.moves = null;
      this.change('Idle');
    }, brakes);
  }
  // Somebody else runs a program, or homes.
  becomes(state: string): void {
    if (this.moves === null) this.change(state);
  }

  turn(): void {
    const now = Date.now();
    // It brakes so early that it rests when the lease is over.
    if (this.moves !== null && (now >= this.leaseEnd - brakes || now >= this.stepEnd)) this.brake();
  }
  // The page loses a connection that has been silent for a while, as connection.ts does.
  publish(): void {
    if (this.cut || connection.value !== 'live') return;
    const told = { change: this.changes, state: this.state, place: {}, owner: { kind: 'nobody', name: '' } };
    this.toldUntil = Math.max(Date.now() + this.delay(), this.toldUntil);
    setTimeout(() => void (status.value = told), this.toldUntil - Date.now());
  }
  follow(): void {
    setInterval(() => this.turn(), 5);
    setInterval(() => this.publish(), each);
  }
}

export class Field {
  constructor(public type: string) {}
  closest = (): Field => this;
  blur(): void {
    browser.focus(null);
  }
}

// As much of a browser as the jog code touches.
class Browser {
  readonly window = new EventTarget();
  readonly document = Object.assign(new EventTarget(), {
    hidden: false,
    activeElement: null as Field | null,
    hasFocus: (): boolean => this.hasFocus,
    querySelector: (): null => null,
  });
  hasFocus = true;
  pads: { connected: boolean; id: string; mapping: string; buttons: { pressed: boolean }[]; axes: number[] }[] = [];

  begin(): void {
    vi.stubGlobal('HTMLElement', Field);
    vi.stubGlobal('HTMLInputElement', Field);
    vi.stubGlobal('document', this.document);
    vi.stubGlobal('addEventListener', this.window.addEventListener.bind(this.window));
    vi.stubGlobal('navigator', { getGamepads: () => this.pads, languages: ['en'] });
  }
  fire(type: string, more: object = {}, at: EventTarget = this.window): boolean {
    const event = new Event(type, { cancelable: true });
    for (const [name, value] of Object.entries({ target: this.document.activeElement, ...more })) Object.defineProperty(event, name, { value });
    return !at.dispatchEvent(event); // true: the browser's own action is prevented
  }
  focus(field: Field | null): void {
    this.document.activeElement = field;
    this.fire(field === null ? 'focusout' : 'focusin');
  }
  key(type: 'keydown' | 'keyup', code: string, more: object = {}): boolean {
    return this.fire(type, { code, ctrlKey: false, altKey: false, metaKey: false, repeat: false, ...more });
  }
  // A click on a choice, as a mouse makes it.
  click(field: Field): void {
    this.fire('pointerup', { pointerId: 99, buttons: 0 });
    this.fire('click', { detail: 1 });
    this.focus(field);
  }
  pointer(type: string, pointerId: number, buttons: number): void {
    this.fire(type, { pointerId, buttons });
  }
}
export const browser = new Browser();
export const daemon = new Daemon();

export const pressPad = (press: (event: PointerEvent, direction: Direction) => void, pointerId: number, direction: Direction): void =>
  press({ button: 0, pointerId, currentTarget: { setPointerCapture: () => undefined } } as unknown as PointerEvent, direction);
