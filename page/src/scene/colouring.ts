// What the colours of the path tell, and above which height nothing is drawn.
import { computed, signal } from '@preact/signals';
import { kept, oneOf } from '../core/kept';
import { pathIndex } from '../machine/path_index';
import { loadsOfShown } from '../machine/studies';
import { fullLoad, speedCode } from './path_data';
import type { Colouring } from './renderer';

export const tells = kept<Colouring['tells']>('path-tells', 'nothing', oneOf('nothing', 'speed', 'depth', 'torque'));

export const colouring = computed<Colouring>(() => {
  const index = pathIndex.value;
  const wanted = tells.value;
  if (wanted === 'speed' && index?.speeds != null) {
    return { tells: wanted, low: speedCode(index.speeds.low), high: speedCode(index.speeds.high) };
  }
  if (wanted === 'depth' && index?.cuts != null) return { tells: wanted, low: index.cuts.low[2], high: index.cuts.high[2] };
  if (wanted === 'torque' && loadsOfShown.value?.state === 'done') return { tells: wanted, low: 0, high: fullLoad };
  return { tells: 'nothing', low: 0, high: 1 };
});

// How much of the path's height is shown, from below: 0 to 1. Null: there is no section.
export const sectionShare = signal<number | null>(null);
const endless = 1e30;
export const section = computed(() => {
  const box = pathIndex.value?.all ?? null;
  const share = sectionShare.value;
  if (box === null || share === null || share >= 1) return endless;
  return box.low[2] + share * (box.high[2] - box.low[2]) + 1e-6;
});
