// What the server reports is translated by codes: each code that it sends has its words, and no other has.
import { afterEach, describe, expect, it } from 'vitest';
import { faults, reportIn, reportWords, type Sentence } from '../src/core/faults';
import { language } from '../src/core/language';
import { units } from '../src/core/units';
import { source, sources, textsOf } from './sources';

afterEach(() => {
  language.value = 'en';
  units.value = 'mm';
});

const valuesOf = (words: string): string[] => (words.match(/\{\w+\}/g) ?? []).sort();

// Codes whose words say more than the page could: what exactly is wrong with a body, or with a value that was set.
const ownWords = ['http.bad-body', 'http.wrong-type', 'board-files.cannot-send', 'machine-file.cannot-set', 'make.cannot-edit', 'reentry.shifted', 'surface.height-map'];
// Of a run on a terminal alone; of faults of the board, which are sent by the code of the link.
const isElsewhere = (code: string): boolean => code === 'run.waits' || code.startsWith('board.');

describe('the words of a code', () => {
  const tables = ['board/link/link.cpp', 'machine/session/refusal.cpp', 'machine/activity/machine_fault.cpp', 'machine/journal/resumption.cpp', 'machine/journal/reentry.cpp', 'machine/job/job_identity.cpp', 'machine/job/kept_job.cpp'];
  const api = sources('interfaces/api');
  const texts = new Set(textsOf([...sources('board/link'), ...sources('machine'), ...sources('interfaces/sender'), ...api]));
  const code = /^(?:http|owner|mdi|jobs?|framing|goto|macro|waits|programs|uploads|data|make|ports|settings|board-files|study|machine|machine-file|run|link|home|probe|program|resume|reentry|way)\.[a-z]+[a-z-]*(?:\.[a-z-]+)*$/;

  it('are there for each code of the tables and of the API', () => {
    const sent = textsOf([...tables.map(source), ...api]).filter((text) => code.test(text) && !isElsewhere(text) && !ownWords.includes(text));
    expect(new Set(sent).size).toBeGreaterThan(120);
    // A code that only ever comes with a finer one has no words of its own.
    const known = Object.keys(faults.en);
    expect([...new Set(sent)].filter((one) => !known.some((fault) => fault === one || fault.startsWith(`${one}.`)))).toEqual([]);
  });

  it('are there for no code that is never sent', () => {
    const isSent = (fault: string): boolean => {
      const dot = fault.lastIndexOf('.');
      const [head, tail] = [fault.slice(0, dot), fault.slice(dot + 1)];
      const hasHead = [head, `${head}.`, `${head}.{}`].some((one) => texts.has(one)) || texts.has(head.split('.')[0] ?? '');
      return texts.has(fault) || (hasHead && (texts.has(tail) || texts.has(`.${tail}`)));
    };
    const all = [...sources('machine/job')].join('');
    expect(Object.keys(faults.en).filter((fault) => !isSent(fault) && !all.includes(`"code":"${fault}"`))).toEqual([]);
  });

  it('name arguments that English has, in each language', () => {
    const codes = Object.keys(faults.en) as (keyof typeof faults.en)[];
    const wrong = [faults.fr, faults.it, faults.zh].map((table) => codes.filter((one) => valuesOf(table[one]).join() !== valuesOf(faults.en[one]).join()));
    expect(wrong).toEqual([[], [], []]);
  });
});

describe('a report', () => {
  const closed: Sentence = { code: 'link.stopped.limit-switch-of-axis', arguments: { axis: 'X' } };

  it('is said in the language of the page, by its code and arguments', () => {
    expect(reportWords('whatever the server says', closed)).toBe('the limit switch of X was triggered: the motor positions are unreliable');
    language.value = 'fr';
    expect(reportWords('whatever the server says', closed)).toBe('le fin de course de X s’est déclenché\u00a0: la position des moteurs n’est plus fiable');
    expect(reportWords('', { code: 'machine.busy.not-idle', arguments: { state: 'Run' } })).toBe('');
    expect(reportWords('x', { code: 'machine.busy.not-idle', arguments: { state: 'Run' } })).toBe('la machine n’est pas au repos\u00a0: Usinage en cours');
    const held = { finding: 'no feed rate is set', 'finding.code': 'gcode.missing-feed' };
    expect(reportWords('x', { code: 'job.finding', arguments: { line: '9', code: 'gcode.missing-feed', ...held } })).toBe(
      'ligne 9\u00a0: aucune avance n’est donnée [gcode.missing-feed]',
    );
  });

  it('shows lengths in the units of the page', () => {
    units.value = 'inch';
    expect(reportWords('up to Z25.400, at rapid speed', { code: 'way.up', arguments: { z: '25.400' } })).toBe('raise to Z1.0000, rapid');
  });

  it('of a code that the page does not know is shown as it came', () => {
    language.value = 'it';
    expect(reportIn({ words: 'something new', sentence: { code: 'machine.new', arguments: {} } })).toBeNull();
    expect(reportWords('something new', { code: 'machine.new', arguments: {} })).toBe('something new');
    expect(reportWords('X.microsteps is 0', null)).toBe('X.microsteps is 0');
  });
});
