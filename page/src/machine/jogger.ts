// Jogging: motion lasts only while somebody holds a key or a button. The daemon gives a lease of 250 ms, which is
// renewed while the hold goes on. Whatever ends the renewals ends the motion: a key that goes up, a window without
// focus, a hidden tab, a frozen page, a network that is gone. See docs/decisions/0092.

export interface JogWay {
  direction: Record<string, number>;
  speed: number; // mm/min
  distance: number; // mm; 0: as far as the hold lasts
}

export interface JogLine {
  begin: (way: JogWay, lease: number) => Promise<number>; // the change of the status with which the motion began
  renew: () => boolean; // false: nobody hears
  stop: () => void;
}

export const lease = 0.25; // s
export const renewEvery = 70; // ms
const mostSteps = 5; // that wait

type Phase = 'rest' | 'asking' | 'moving' | 'braking';

// It asks for one motion at a time. Another direction brakes first, and begins at rest.
export class Jogger {
  private want: JogWay | null = null; // held
  private steps: JogWay[] = [];
  private phase: Phase = 'rest';
  private current: JogWay | null = null;
  private cancelled = false;
  private begunWith = 0; // a status of a smaller change is from before the motion
  private newest = { state: '', change: 0 };
  private timer: ReturnType<typeof setInterval> | undefined;

  constructor(
    private readonly line: JogLine,
    private readonly refused: (error: unknown) => void,
  ) {}

  // What moves, or is about to.
  get way(): JogWay | null {
    return this.current;
  }
  get rests(): boolean {
    return this.phase === 'rest';
  }

  // Moves until letGo() or release(), or until another way is held.
  hold(way: JogWay): void {
    this.steps = [];
    this.want = way;
    this.kick();
  }

  // Nothing is held any more. A step goes on to its end.
  letGo(): void {
    this.want = null;
    if (this.phase === 'asking' && this.current?.distance === 0) this.cancelled = true;
    this.kick();
  }

  // Nothing is held any more, and no step goes on.
  release(): void {
    this.want = null;
    this.steps = [];
    if (this.phase === 'asking') this.cancelled = true;
    if (this.phase === 'moving') this.brake();
  }

  // Moves so far, and ends by itself.
  step(way: JogWay): void {
    if (this.want !== null || this.steps.length >= mostSteps) return;
    this.steps.push(way);
    this.kick();
  }

  // The daemon tells the machine's state. A busy computer may tell late what was before the motion, and a short step may
  // begin and end between two messages.
  heard(state: string, change: number): void {
    this.newest = { state, change };
    if (this.phase !== 'moving' && this.phase !== 'braking') return;
    if (state === 'Jog' || change < this.begunWith) return;
    // A hold that ended by itself, at the end of the travel, does not begin again.
    if (this.want === this.current) this.want = null;
    this.rest();
    this.kick();
  }

  private kick(): void {
    if (this.phase === 'moving' && this.current !== null && this.current.distance === 0 && this.want !== this.current) this.brake();
    if (this.phase !== 'rest') return;
    const next = this.want ?? this.steps.shift();
    if (next === undefined) return;
    this.phase = 'asking';
    this.current = next;
    this.cancelled = false;
    this.timer ??= setInterval(() => this.renew(), renewEvery);
    void this.begin(next);
  }

  private async begin(way: JogWay): Promise<void> {
    try {
      this.begunWith = await this.line.begin(way, lease);
    } catch (error) {
      this.want = null;
      this.steps = [];
      this.rest();
      this.refused(error);
      return;
    }
    this.phase = 'moving';
    if (this.cancelled) this.brake();
    else this.kick();
    this.heard(this.newest.state, this.newest.change); // the end may have been told before the answer came
  }

  private brake(): void {
    this.phase = 'braking';
    this.line.stop();
  }

  // Also while the answer is on its way: the motion may have begun, and a busy browser may be slow to tell.
  private renew(): void {
    const begins = this.phase === 'asking' && !this.cancelled && (this.current === this.want || this.current?.distance !== 0);
    if ((begins || this.phase === 'moving') && !this.line.renew()) this.release();
  }

  private rest(): void {
    this.phase = 'rest';
    this.current = null;
    clearInterval(this.timer);
    this.timer = undefined;
  }
}
