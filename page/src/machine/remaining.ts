// How long a job still takes. At first from the time at the programmed speeds; then from how fast it really goes.

interface Sample {
  time: number; // s, of the board
  progress: number; // 0 to 1
}

const window = 60; // s that count
const trustAfter = 20; // s of motion until the real pace counts alone

export class RemainingTime {
  private samples: Sample[] = [];

  // `seconds`: of the whole program at the programmed speeds. Undefined: nobody knows.
  tell(time: number, progress: number | null, seconds: number, moves: boolean): number | undefined {
    if (progress === null) return undefined;
    const last = this.samples.at(-1);
    if (last !== undefined && (time < last.time || progress < last.progress)) this.samples = [];
    // A hold stops the clock: its time is no part of the pace.
    if (moves) this.note({ time, progress });
    else this.samples = [];
    const nominal = seconds * (1 - progress);
    const pace = this.pace();
    if (pace === undefined) return seconds > 0 ? nominal : undefined;
    const real = (1 - progress) / pace.rate;
    const share = Math.min(1, pace.over / trustAfter);
    return seconds > 0 ? real * share + nominal * (1 - share) : real;
  }

  private note(sample: Sample): void {
    const last = this.samples.at(-1);
    if (last !== undefined && sample.time - last.time < 0.5) return;
    this.samples.push(sample);
    while (this.samples[0] !== undefined && sample.time - this.samples[0].time > window) this.samples.shift();
  }

  private pace(): { rate: number; over: number } | undefined {
    const [first, last] = [this.samples[0], this.samples.at(-1)];
    if (first === undefined || last === undefined) return undefined;
    const over = last.time - first.time;
    const rate = (last.progress - first.progress) / over;
    return over >= 2 && rate > 1e-7 ? { rate, over } : undefined;
  }
}
