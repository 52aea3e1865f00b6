// Playing a move: time as a share of the whole move, and which pulses have come by then.
import { useEffect, useState } from 'preact/hooks';

// How many pulses have come at `share` of the time. `clock` ascends to 1.
export function beatAt(clock: readonly number[], share: number): number {
  let low = 0;
  let high = clock.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((clock[middle] ?? 1) <= share + 1e-9) low = middle + 1;
    else high = middle;
  }
  return low;
}
export function shareOf(clock: readonly number[], beat: number): number {
  return beat <= 0 ? 0 : (clock[Math.min(beat, clock.length) - 1] ?? 1);
}

// Short moves are played slowly enough to count along, long ones within some seconds.
export function secondsFor(pulses: number): number {
  return Math.min(14, Math.max(3, pulses / 5));
}

// While `playing`, the share grows from `from()` to 1, and `show` gets it at each picture of the screen.
export function usePlaying(
  playing: boolean,
  seconds: number,
  from: () => number,
  show: (share: number) => void,
  ended: () => void,
): void {
  useEffect(() => {
    if (!playing) return;
    let share = from();
    if (share >= 1) share = 0;
    let last = performance.now();
    let request = requestAnimationFrame(function picture(now) {
      share = Math.min(1, share + (now - last) / 1000 / seconds);
      last = now;
      show(share);
      if (share >= 1) ended();
      else request = requestAnimationFrame(picture);
    });
    return () => cancelAnimationFrame(request);
  }, [playing, seconds]);
}

export function useReducedMotion(): boolean {
  const [reduced, setReduced] = useState(() => matchMedia('(prefers-reduced-motion: reduce)').matches);
  useEffect(() => {
    const asked = matchMedia('(prefers-reduced-motion: reduce)');
    const changed = (): void => setReduced(asked.matches);
    asked.addEventListener('change', changed);
    return () => asked.removeEventListener('change', changed);
  }, []);
  return reduced;
}
