import { expect, test } from 'vitest';
import type { Pendant } from '../src/machine/api';
import { pendantWords } from '../src/machine/pendant';

const pendant: Pendant = {
  name: 'XHC WHB04B',
  connected: true,
  link: true,
  axis: 'x',
  continuous: false,
  step: 0.01,
  share: 0.05,
  refusal: '',
  refusal_sentence: { code: '', arguments: {} },
};

test('the words of a pendant say what its wheel would do', () => {
  expect(pendantWords(null)).toBe('');
  expect(pendantWords(undefined)).toBe('');
  expect(pendantWords(pendant)).toBe('Pendant XHC WHB04B: X, 0.010 mm per detent.');
  expect(pendantWords({ ...pendant, axis: 'a', step: 1 })).toContain('A, 1.000 ° per detent');
  expect(pendantWords({ ...pendant, continuous: true })).toContain('X, 5 % of the highest speed');
  expect(pendantWords({ ...pendant, step: 0 })).toContain('no step selected');
  expect(pendantWords({ ...pendant, axis: null })).toContain('no axis selected');
  expect(pendantWords({ ...pendant, link: false })).toContain('out of reach');
  expect(pendantWords({ ...pendant, connected: false, link: false })).toContain('unplugged');
});

test('they say why the last key was refused', () => {
  const refused = { ...pendant, refusal: 'the machine is busy', refusal_sentence: { code: 'machine.busy', arguments: {} } };
  expect(pendantWords(refused)).toContain('Refused: the machine is busy.');
});
