import { effect, signal } from '@preact/signals';
import { expect, it } from 'vitest';
import { stable } from '../src/core/stable';

it('tells only what has changed', () => {
  const status = signal({ place: { x: 1 }, time: 0 });
  const place = stable(() => ({ ...status.value.place }));
  const told: number[] = [];
  effect(() => void told.push(place.value.x));
  for (let time = 1; time < 5; ++time) status.value = { place: { x: 1 }, time };
  expect(told).toEqual([1]);
  status.value = { place: { x: 2 }, time: 9 };
  expect(told).toEqual([1, 2]);
});
