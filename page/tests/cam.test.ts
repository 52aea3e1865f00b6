// The forms of CAM: what a person types, and what is sent.
import { afterEach, describe, expect, it } from 'vitest';
import { units } from '../src/core/units';
import { operations as en } from '../src/lang/en/operations';
import { formFor, forms, usualOf, withUnit, type Field } from '../src/pages/cam_forms';
import { fieldsOf } from '../src/pages/cam_order';
import { knowOperations } from './description';

knowOperations();

const field = (job: string, option: string): Field => {
  const form = forms.value.find((one) => one.job === job);
  const found = form === undefined ? undefined : fieldsOf(form).find((one) => one.option === option);
  if (found === undefined) throw new Error(`${job} has no ${option}`);
  return found;
};

afterEach(() => (units.value = 'mm'));

describe('a length', () => {
  it('that has no unit is in the unit of the page, each of a list', () => {
    expect(withUnit(field('profile', 'depth'), '-1.5')).toBe('-1.5mm');
    units.value = 'inch';
    expect(withUnit(field('profile', 'depth'), '-.06')).toBe('-.06in');
    expect(withUnit(field('profile', 'tool'), '1/8')).toBe('1/8in');
    expect(withUnit(field('isolate', 'tool'), '0.04, 0.2mm')).toBe('0.04in,0.2mm');
    expect(withUnit(field('profile', 'depth'), '')).toBe('');
  });
  it('keeps the unit that it has', () => {
    units.value = 'inch';
    expect(withUnit(field('profile', 'depth'), '-30mil')).toBe('-30mil');
  });
  it('stands in the unit of the page where nothing is filled in', () => {
    expect(usualOf(field('profile', 'tool'))).toBe('2mm');
    units.value = 'inch';
    expect(usualOf(field('profile', 'tool'))).toBe('0.0787in');
    expect(usualOf(field('profile', 'spindle'))).toBe('12000');
  });
});

describe('what is no length', () => {
  it('gets no unit', () => {
    units.value = 'inch';
    for (const [job, option] of [['profile', 'spindle'], ['profile', 'tabs'], ['engrave', 'text'], ['engrave', 'angle'], ['relief', 'cutter'], ['relief', 'removal'], ['pocket', 'step-over']] as const) {
      expect(withUnit(field(job, option), '12')).toBe('12');
    }
    expect(withUnit(field('profile', 'dog-bones'), true)).toBe(true);
  });
});

describe('files', () => {
  it('lead to the form that takes them', () => {
    const [first] = forms.value;
    expect(formFor(['a.svg'], first)?.job).toBe('profile');
    expect(formFor(['a.drl'], first)?.job).toBe('drill');
    expect(formFor(['a.gtl', 'a.drl'], first)?.job).toBe('board');
    expect(formFor(['a.png'], first)?.job).toBe('relief');
    expect(formFor(['wing.dat'], first)?.job).toBe('wire');
  });
});

describe('words', () => {
  it('are there for each option and choice, and for nothing else', () => {
    const used = new Set<string>();
    for (const form of forms.value) {
      used.add(form.title);
      for (const field of fieldsOf(form)) {
        used.add(field.title);
        for (const [, words] of field.choices) used.add(words);
        if (field.without !== null) used.add(field.without);
      }
    }
    expect([...used].sort()).toEqual(Object.keys(en).sort());
  });
});

describe('an option', () => {
  it('is what its description says', () => {
    expect(field('isolate', 'passes')).toMatchObject({ kind: 'text', usual: '1', isLength: false });
    expect(field('outline', 'mirror').choices.map(([one]) => one)).toEqual(['x', 'y']);
    expect(field('relief', 'way')).toMatchObject({ kind: 'choice', usual: 'rows', without: 'cam.option.way.rows' });
    expect(field('relief', 'way').choices.map(([one]) => one)).not.toContain('rows');
    expect(field('isolate', 'edge')).toMatchObject({ kind: 'file', without: 'cam.option.edge.none' });
  });
  it('has the words of its operation where they are others', () => {
    expect([field('drill', 'feed').title, field('pocket', 'feed').title]).toEqual(['cam.drill.feed', 'cam.option.feed']);
  });
  it('of one job is decided by a board itself', () => {
    expect(['mirror', 'zero', 'edge'].every((option) => field('isolate', option).ofJob)).toBe(true);
    expect(field('isolate', 'tool').ofJob).toBe(false);
  });
});
