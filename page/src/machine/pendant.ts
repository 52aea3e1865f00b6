// What a pendant at the daemon's computer is set to, in words.
import { reportWords } from '../core/faults';
import { say } from '../core/language';
import { isRotary, lengthUnit, placeText } from '../core/units';
import type { Pendant } from './api';

function settings(pendant: Pendant): string {
  const { name, axis } = pendant;
  if (!pendant.connected) return say('jog.pendant.gone', { name });
  if (!pendant.link) return say('jog.pendant.no-link', { name });
  if (axis === null) return say('jog.pendant.no-axis', { name });
  const letter = axis.toUpperCase();
  if (pendant.continuous) return say('jog.pendant.continuous', { name, axis: letter, percent: Math.round(pendant.share * 100) });
  const step = `${placeText(axis, pendant.step)} ${isRotary(axis) ? '°' : lengthUnit()}`;
  return pendant.step > 0 ? say('jog.pendant.step', { name, axis: letter, step }) : say('jog.pendant.no-step', { name, axis: letter });
}

// Empty: there is none.
export function pendantWords(pendant: Pendant | null | undefined): string {
  if (pendant === null || pendant === undefined) return '';
  const refusal = reportWords(pendant.refusal, pendant.refusal_sentence);
  return refusal === '' ? settings(pendant) : `${settings(pendant)} ${say('jog.pendant.refused', { why: refusal })}`;
}
