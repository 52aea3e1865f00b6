// How others read who has the motion.
import { afterEach, describe, expect, it } from 'vitest';
import { language } from '../src/core/language';
import { connection, status } from '../src/machine/connection';
import type { Status } from '../src/machine/api';
import { ownership } from '../src/machine/owner';
import { ownerKey, ownerTaken } from '../src/machine/owner_key';
import { deviceName, nameInWords } from '../src/machine/page_name';

const android = 'Mozilla/5.0 (Android 14; Mobile; rv:130.0) Gecko/130.0 Firefox/130.0';
const linux = 'Mozilla/5.0 (X11; Linux x86_64) AppleWebKit/537.36 (KHTML, like Gecko) Chrome/126.0.0.0 Safari/537.36';
const windows = 'Mozilla/5.0 (Windows NT 10.0; Win64; x64) AppleWebKit/537.36 (KHTML, like Gecko) Chrome/126.0.0.0 Safari/537.36 Edg/126.0.0.0';
const mac = 'Mozilla/5.0 (Macintosh; Intel Mac OS X 10_15_7) AppleWebKit/605.1.15 (KHTML, like Gecko) Version/17.4 Safari/605.1.15';
const name = (userAgent: string, brands: string[] = [], touches = false): string => deviceName({ userAgent, brands, touches });

afterEach(() => (language.value = 'en'));

describe('the name of a page', () => {
  it('is that of its browser and its device', () => {
    expect(name(android)).toBe('Firefox on Android');
    expect(name(linux, ['Not;A=Brand', 'Chromium'])).toBe('Chromium on Linux');
    expect(name(linux, ['Chromium', 'Google Chrome'])).toBe('Chrome on Linux');
    expect(name(windows)).toBe('Edge on Windows');
    expect(name(mac)).toBe('Safari on macOS');
    expect(name(mac, [], true)).toBe('Safari on iPad');
    expect(name('strange')).toBe('Browser');
  });

  it('is said in the language of the page, and a given one as it was given', () => {
    language.value = 'fr';
    expect(nameInWords('Firefox on Android')).toBe('Firefox sur Android');
    expect(nameInWords('Tablet on the mill')).toBe('Tablet on the mill');
  });

  it('may be that of another page: the ownership is told by its number', () => {
    connection.value = 'live';
    ownerKey.value = 'key';
    ownerTaken.value = 4;
    const owner = (taken: number): void => void (status.value = { owner: { kind: 'client', name: 'Chromium on Linux', taken } } as Status);
    owner(4);
    expect(ownership.value).toBe('mine');
    owner(5);
    expect(ownership.value).toBe('other');
  });
});
