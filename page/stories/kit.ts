// What the stories share: the real daemon with its virtual machine, and the real browser.
import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import { createRequire } from 'node:module';
import type { AddressInfo } from 'node:net';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { chromium, type Browser, type BrowserContext, type Page } from 'playwright-core';
import type { Status } from '../src/machine/api';

const root = resolve(import.meta.dirname ?? '.', '../..');
export const passo = process.env.PASSO_PROGRAM ?? join(root, 'build/release/passo');
export const pageFolder = process.env.PASSO_PAGE ?? join(root, 'build/page');
const browserPaths = [process.env.PASSO_CHROMIUM, '/usr/bin/chromium', '/usr/bin/google-chrome'];
export const example = (name: string): string => join(root, 'examples', name);

// The usual machine, but so small that homing does not take a minute.
export function smallMachine(folder: string): string {
  const file = join(folder, 'small.toml');
  const text = readFileSync(join(root, 'examples/machines/router.toml'), 'utf8');
  const smaller: [string, string][] = [['-400, 400', '-100, 100'], ['-401', '-101'], ['-300, 300', '-80, 80'], ['-301', '-81']];
  writeFileSync(file, smaller.reduce((so, [was, is]) => so.replace(was, is), text));
  return file;
}

// What a program says until it is ready.
async function saying(child: ChildProcess, ready: (said: string) => boolean): Promise<string> {
  return new Promise<string>((done, fail) => {
    let said = '';
    child.stdout?.on('data', (bytes: Buffer) => {
      said += bytes.toString();
      if (ready(said)) done(said);
    });
    child.on('exit', (code) => fail(new Error(`the program has ended with ${code}: ${said}`)));
    child.on('error', fail);
  });
}

// A story that fails leaves nobody behind.
const begun = new Set<ChildProcess>();
process.once('exit', () => begun.forEach((one) => one.kill('SIGKILL')));
function begin(words: readonly string[]): ChildProcess {
  const child = spawn(passo, words, { stdio: ['ignore', 'pipe', 'inherit'] });
  begun.add(child);
  child.once('exit', () => begun.delete(child));
  return child;
}

const kill = async (child: ChildProcess, signal: 'SIGTERM' | 'SIGKILL'): Promise<void> => {
  if (child.exitCode !== null || child.signalCode !== null) return;
  const ended = new Promise((done) => child.once('exit', done));
  child.kill(signal);
  await ended;
};

// A virtual board as a program of its own, which outlives the daemon.
export class Board {
  private constructor(
    private readonly process: ChildProcess,
    readonly port: string,
  ) {}
  static async start(machine: string): Promise<Board> {
    const child = begin(['board', 'serve', '--port', '0', '--machine', machine]);
    const said = await saying(child, (all) => /tcp:[\d.]+:\d+/.test(all));
    return new Board(child, /tcp:[\d.]+:(\d+)/.exec(said)?.[1] ?? '');
  }
  // It forgets all, and the motors stay where they are.
  cutPower(): void {
    this.process.kill('SIGUSR1');
  }
  end = (): Promise<void> => kill(this.process, 'SIGTERM');
}

// A strict grbl of the tests, as a program of its own.
export const strictGrbl = process.env.PASSO_STRICT_GRBL ?? join(root, 'build/release/tests/strict_grbl_on_line');
export const peers = join(root, '../shared/peers/grbl');

// What another program says on its first line, and the program; it is killed when the story ends.
export class Peer {
  private constructor(private readonly process: ChildProcess) {}
  static async start(words: readonly string[], folder: string, ready: () => boolean): Promise<Peer> {
    const child = spawn(words[0] ?? '', words.slice(1), { stdio: ['pipe', 'ignore', 'ignore'], cwd: folder });
    begun.add(child);
    child.once('exit', () => begun.delete(child));
    for (const end = Date.now() + 20_000; !ready() && Date.now() < end; ) await sleep(50);
    return new Peer(child);
  }
  say(line: string): void {
    this.process.stdin?.write(`${line}\n`);
  }
  end = (): Promise<void> => kill(this.process, 'SIGKILL');
}

// A camera in the network: a stream with one picture again and again, as ustreamer sends it.
export class MjpegCamera {
  private constructor(
    private readonly server: Server,
    readonly url: string,
  ) {}
  static async start(jpeg: Buffer): Promise<MjpegCamera> {
    const server = createServer((_, answer) => {
      answer.writeHead(200, { 'Content-Type': 'multipart/x-mixed-replace;boundary=boundarydonotcross' });
      answer.write('--boundarydonotcross\r\n');
      const send = (): void => {
        answer.write(`Content-Type: image/jpeg\r\nContent-Length: ${jpeg.length}\r\n\r\n`);
        answer.write(jpeg);
        answer.write('\r\n--boundarydonotcross\r\n');
      };
      const timer = setInterval(send, 100);
      answer.on('close', () => clearInterval(timer));
    });
    await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
    return new MjpegCamera(server, `http://127.0.0.1:${(server.address() as AddressInfo).port}/stream`);
  }
  end(): void {
    this.server.close();
    this.server.closeAllConnections();
  }
}

interface FakePort {
  name: string; // "ttyACM0"
  vendor: string;
  product: string;
  words: string;
  leadsTo?: string; // a terminal; otherwise it is no serial port
  lasting?: string; // its name in by-id
  user?: { process: number; program: string };
}
// The files in which a computer's system tells of its serial ports.
export function systemWith(folder: string, ports: readonly FakePort[]): string {
  const system = join(folder, 'system');
  const write = (file: string, text: string): void => {
    mkdirSync(join(system, file, '..'), { recursive: true });
    writeFileSync(join(system, file), text);
  };
  write('proc/locks', '');
  for (const one of ports) {
    const usb = `sys/devices/usb1/1-${one.name}`;
    write(`${usb}/idVendor`, `${one.vendor}\n`);
    write(`${usb}/idProduct`, `${one.product}\n`);
    write(`${usb}/product`, `${one.words}\n`);
    const tty = `${usb}/1-1:1.0/tty/${one.name}`;
    for (const made of [tty, 'sys/class/tty', 'dev/serial/by-id']) mkdirSync(join(system, made), { recursive: true });
    symlinkSync('../../../1-1:1.0', join(system, tty, 'device'));
    symlinkSync(join(system, tty), join(system, 'sys/class/tty', one.name));
    if (one.leadsTo !== undefined) symlinkSync(one.leadsTo, join(system, 'dev', one.name));
    else write(`dev/${one.name}`, '');
    if (one.lasting !== undefined) symlinkSync(`../../${one.name}`, join(system, 'dev/serial/by-id', one.lasting));
    if (one.user === undefined) continue;
    write(`proc/${one.user.process}/comm`, `${one.user.program}\n`);
    mkdirSync(join(system, `proc/${one.user.process}/fd`), { recursive: true });
    symlinkSync(join(system, 'dev', one.name), join(system, `proc/${one.user.process}/fd/5`));
  }
  return system;
}

interface Start {
  port?: string;
  system?: string; // a folder of systemWith()
  address?: string; // of a board that is no virtual one
  machine?: string;
  board?: Board;
  data?: string; // a folder that outlives the daemon
  touch?: readonly string[]; // what the virtual probe can touch
  macros?: string; // a folder
}

export class Daemon {
  private constructor(
    private readonly process: ChildProcess,
    readonly address: string,
    private readonly folder: string,
  ) {}

  static async start({ port = '0', machine, board, data, touch = [], macros, system, address }: Start = {}): Promise<Daemon> {
    const folder = mkdtempSync(join(tmpdir(), 'passo-story-'));
    const words = ['serve', '--http', `127.0.0.1:${port}`, '--grbl-tcp', '127.0.0.1:0', '--page', pageFolder, '--data', data ?? folder];
    words.push('--machine', machine ?? smallMachine(folder));
    for (const one of touch) words.push('--touch', one);
    if (macros !== undefined) words.push('--macros', macros);
    if (board !== undefined) words.push('--board', `tcp:127.0.0.1:${board.port}`);
    if (address !== undefined) words.push('--board', address);
    if (system !== undefined) words.push('--system', system);
    const child = begin(words);
    const found = /http:\/\/127\.0\.0\.1:\d+\//;
    const said = await saying(child, (all) => found.test(all) && all.includes('Ctrl-C'));
    return new Daemon(child, found.exec(said)?.[0] ?? '', folder);
  }

  async get<T>(path: string): Promise<T> {
    return (await (await fetch(`${this.address}api/v1${path}`)).json()) as T;
  }
  async post(path: string, body: string, key = ''): Promise<Record<string, unknown>> {
    const answer = await fetch(`${this.address}api/v1${path}`, { method: 'POST', body, headers: { 'X-Passo-Key': key } });
    return (await answer.json()) as Record<string, unknown>;
  }
  status(): Promise<Status> {
    return this.get<Status>('/status');
  }
  async until(what: (status: Status) => boolean, within = 60_000): Promise<Status> {
    const end = Date.now() + within;
    for (;;) {
      const status = await this.status();
      if (what(status)) return status;
      if (Date.now() > end) throw new Error(`waited in vain: ${JSON.stringify(status)}`);
      await sleep(20);
    }
  }

  async end(signal: 'SIGTERM' | 'SIGKILL' = 'SIGTERM'): Promise<void> {
    await kill(this.process, signal);
    rmSync(this.folder, { recursive: true, force: true });
  }
}

export const sleep = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

// As on a computer without a graphics card: Chromium chooses what draws the page, and WebGL is drawn by SwiftShader.
export async function openBrowser(): Promise<Browser> {
  const executablePath = browserPaths.find((one) => one !== undefined && existsSync(one));
  if (executablePath === undefined) throw new Error('there is no Chromium: apt-get install chromium');
  return chromium.launch({
    executablePath,
    args: ['--no-sandbox', '--disable-dev-shm-usage', '--enable-unsafe-swiftshader', '--force-color-profile=srgb'],
  });
}

export interface Visit {
  language?: string;
  theme?: 'dark' | 'light';
  size?: { width: number; height: number };
  units?: 'mm' | 'inch';
  density?: number;
  before?: (page: Page) => Promise<void>; // the page is loaded
}

// A browser of another person: nothing of it is shared with others.
export async function visit(browser: Browser, daemon: Daemon, path: string, how: Visit = {}): Promise<{ context: BrowserContext; page: Page; errors: string[] }> {
  const context = await browser.newContext({
    viewport: how.size ?? { width: 1280, height: 800 },
    colorScheme: how.theme ?? 'dark',
    locale: how.language ?? 'en',
    reducedMotion: 'reduce',
    deviceScaleFactor: how.density ?? 1,
  });
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  const errors: string[] = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => {
    // What CAM has made may be gone before it is fetched: the next letter of a field has begun another order.
    const isOfEarlierOrder = /\/api\/v1\/(cam\/(picture|page)|study|programs\/\d+)\b/.test(message.location().url) && message.text().includes('404');
    const isOfLine = message.text().includes('ERR_') || message.text().includes('WebSocket');
    if (message.type() === 'error' && !isOfLine && !isOfEarlierOrder) errors.push(`${message.text()} ${message.location().url}`);
  });
  if (how.units !== undefined) await page.addInitScript(`localStorage.setItem('passo.units', '"${how.units}"')`);
  await how.before?.(page);
  await page.goto(`${daemon.address}#/${path}`);
  await page.getByTestId('state').waitFor();
  return { context, page, errors };
}

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
// What axe-core finds wrong with the page as it is. It runs as the project's own tool, not as a script of the page: the
// page's policy stays as it is.
export async function violations(page: Page): Promise<string[]> {
  const found = await page.evaluate(`(async () => { ${axe}; return (await axe.run(document, {resultTypes: ['violations']})).violations; })()`);
  return (found as { id: string; nodes: { html: string }[] }[]).map((one) => `${one.id}: ${one.nodes.map((node) => node.html).join(' ')}`);
}
