// Macros and questions with values: what is asked for, what is wrong, and which key opens which question.
import { afterEach, describe, expect, it } from 'vitest';
import { answers, asked, askValues, faultOf, type AskedField } from '../src/core/question';
import type { Status } from '../src/machine/api';
import { connection, status } from '../src/machine/connection';
import { fieldOf, macros, onMacroKey, type Macro } from '../src/machine/macros';
import { whyNoAnswer } from '../src/parts/asked_values';

const face: Macro = {
  name: 'face',
  title: 'Face the stock',
  key: 'F6',
  values: [
    { name: 'width', title: 'Width', unit: 'mm', low: 1, high: 400, whole: false, default: 100 },
    { name: 'passes', title: 'Passes', unit: '', low: 1, high: 9, whole: true, default: null },
  ],
};
const rests = (state: Status['state']): void => {
  connection.value = 'live';
  status.value = { state, waits: null, holds: [], rests: true, owner: { kind: 'nobody', name: '', taken: 0 }, mdi: {}, job: null } as unknown as Status;
};
const press = (key: string, more = {}) => ({ key, shiftKey: false, preventDefault: () => {}, ...more });

afterEach(() => {
  asked.value?.answer(false);
  macros.value = [];
  status.value = null;
  connection.value = 'connecting';
});

describe('a question with values', () => {
  const fields = face.values.map(fieldOf);
  const question = { title: 'a', facts: [], fields, yes: 'Run', kind: 'go' as const };

  it('has no answer until each value is there and in its range', async () => {
    const answer = askValues(question);
    expect(answers.value).toEqual({ width: 100, passes: null });
    expect(whyNoAnswer(question)).toBe('Passes: 1 to 9');
    for (const wrong of [0, 10, 1.5]) {
      answers.value = { ...answers.value, passes: wrong };
      expect(faultOf(fields[1] as AskedField), String(wrong)).toBe('range');
    }
    answers.value = { ...answers.value, passes: 3 };
    expect(whyNoAnswer(question)).toBe('');
    asked.value?.answer(true);
    expect(await answer).toEqual({ width: 100, passes: 3 });
  });

  it('leaves out what is empty, where that has a meaning', async () => {
    const answer = askValues({ ...question, fields: [{ ...(fields[1] as AskedField), usual: 'clearance' }] });
    expect(whyNoAnswer(question)).not.toBe('');
    asked.value?.answer(true);
    expect(await answer).toEqual({});
  });

  it('is answered by nothing if nobody wants it', async () => {
    const answer = askValues(question);
    asked.value?.answer(false);
    expect(await answer).toBeNull();
  });
});

describe('the key of a macro', () => {
  it('opens its question where the machine can run it', () => {
    macros.value = [face];
    rests('Idle');
    expect(onMacroKey(press('F7'))).toBe(false);
    expect(onMacroKey(press('F6', { shiftKey: true }))).toBe(false);
    expect(asked.value).toBeNull();
    expect(onMacroKey(press('F6'))).toBe(true);
    expect(asked.value?.title).toContain('Face the stock');
    expect(onMacroKey(press('F6')), 'in an open question').toBe(false);
  });

  it('only tells why, while a program runs', () => {
    macros.value = [face];
    rests('Run');
    expect(onMacroKey(press('F6'))).toBe(true);
    expect(asked.value).toBeNull();
  });
});
