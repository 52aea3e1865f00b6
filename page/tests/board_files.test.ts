import { describe, expect, it } from 'vitest';
import type { MachineAbility, Status } from '../src/machine/api';
import { addressOf, hasStorage, isThere, kiloBytes, pathFor, type BoardFilesTold } from '../src/machine/board_files';
import { machine } from '../src/machine/connection';
import { stateWords } from '../src/machine/words';
import { description } from './description';

const told: BoardFilesTold = {
  has_storage: true, folder: '/sd/', why_no_upload: null, words_no_upload: '', state: 'done', order: 'list', path: '', why: null, words: '', share: 0, left: null,
  files: [{ path: '/sd/jobs/a part.nc', bytes: 1234, can_run: true, program: null }],
};

describe('the files of a board', () => {
  it('are told as the server describes them', () => {
    interface Schema {
      properties: Record<string, { items?: { properties: Record<string, unknown> } }>;
    }
    const { properties } = description().components.schemas.BoardFiles as Schema;
    expect(Object.keys(properties).sort()).toEqual(Object.keys(told).sort());
    expect(Object.keys(properties.files?.items?.properties ?? {}).sort()).toEqual(Object.keys(told.files?.[0] ?? {}).sort());
  });

  it('have addresses that keep every character of their paths', () => {
    expect(addressOf('/sd/jobs/a part.nc')).toBe('/board/files/sd/jobs/a%20part.nc');
    expect(addressOf('/50%#?.nc')).toBe('/board/files/50%25%23%3F.nc');
  });

  it('go into the folder of the card, and replace those of the same name', () => {
    expect(pathFor('/sd/', 'part.nc')).toBe('/sd/part.nc');
    expect(isThere(told, '/sd/jobs/a part.nc')).toBe(true);
    expect(isThere(told, '/sd/part.nc')).toBe(false);
    expect(isThere(null, '/sd/part.nc')).toBe(false);
  });

  it('have sizes in kilobytes', () => {
    expect([kiloBytes(0), kiloBytes(1234), kiloBytes(64_000_000)]).toEqual(['0.0', '1.2', '64000']);
  });

  it('are shown where the board has storage', () => {
    const ability = (can: boolean): MachineAbility => ({ ability: 'board-files', can, why: can ? '' : 'this board stores no files', sentence: null });
    type Known = NonNullable<typeof machine.value>;
    expect(hasStorage.value).toBe(false);
    machine.value = { abilities: [ability(false)] } as unknown as Known;
    expect(hasStorage.value).toBe(false);
    machine.value = { abilities: [ability(true)] } as unknown as Known;
    expect(hasStorage.value).toBe(true);
  });

  it('that the board runs are told instead of a line', () => {
    const status = { state: 'Run', rests: false, holds: [], line: 0, board_file: '/part.nc', waits: null, waits_for_tool: null, job: null } as unknown as Status;
    expect(stateWords({ status, program: 'none', canHome: false, broken: '' }).next).toBe('The board runs /part.nc by itself');
    expect(stateWords({ status: { ...status, board_file: null, line: 7 }, program: 'open', canHome: false, broken: '' }).next).toBe('Line 7');
  });
});
