// What each file of stories has: a browser, and a daemon with its virtual machine. It is not in kit.ts, because pictures.ts
// and measures.ts use that without a runner of tests.
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll } from 'vitest';
import { Daemon, openBrowser } from './kit';

export let browser: Browser;
export let daemon: Daemon;

export function beginStage(): void {
  beforeAll(async () => {
    browser = await openBrowser();
    daemon = await Daemon.start();
  });
  afterAll(async () => {
    await browser?.close();
    await daemon?.end();
  });
}
