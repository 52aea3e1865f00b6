// node same_check.mjs check.wasm passo SOURCE: the browser's module finds in the examples what `passo check --json` finds:
// the same errors, times, extents, limits of the speed and lost steps. Numbers may differ in the last digits, since the two
// C libraries do not round each sine alike (src/core/geometry/wasm/accurate_math.cpp).
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readdirSync, readFileSync } from 'node:fs';
import { basename, join } from 'node:path';

const [wasmFile, passoProgram, source] = process.argv.slice(2);
const examples = join(source, 'examples');
const digits = 13;

const compiled = new WebAssembly.Module(readFileSync(wasmFile));
// As the page's worker does it (page/src/check/host.ts).
function checkInModule(files, request) {
  let memory;
  const stages = new Set();
  const bytesAt = (at, size) => new Uint8Array(memory.buffer, at, size);
  const nameAt = (at, size) => new TextDecoder().decode(bytesAt(at, size));
  const host = {
    size: (at, length) => files[nameAt(at, length)]?.length ?? -1,
    read: (at, length, to, size, from) => {
      const part = files[nameAt(at, length)].subarray(from, from + size);
      bytesAt(to, part.length).set(part);
      return part.length;
    },
    progress: (stage, share) => {
      assert.ok(share >= 0 && share <= 1, `a share of ${share}`);
      stages.add(stage);
    },
  };
  const imports = { host };
  for (const { module: from, name } of WebAssembly.Module.imports(compiled)) {
    if (from !== 'host') (imports[from] ??= {})[name] = () => 8; // EBADF
  }
  const module = new WebAssembly.Instance(compiled, imports).exports;
  memory = module.memory;
  module._initialize();
  const text = new TextEncoder().encode(typeof request === 'string' ? request : JSON.stringify(request));
  bytesAt(module.check_room(text.length), text.length).set(text);
  const length = module.check_program();
  const answer = JSON.parse(new TextDecoder().decode(bytesAt(module.check_answer(), length)));
  return { answer, module, memory, stages };
}

const run = (words) =>
  new Promise((done) => {
    const child = spawn(passoProgram, words);
    let out = '';
    let err = '';
    child.stdout.on('data', (data) => (out += data));
    child.stderr.on('data', (data) => (err += data));
    child.on('close', (status) => done({ status, out, err }));
  });

// What differs, as "margin/worst_lines/0/line: 12, not 13". Of the program's answer each key must be there.
function differences(mine, theirs, path = '') {
  if (typeof theirs === 'number' && typeof mine === 'number') {
    const off = Math.abs(mine - theirs);
    return off <= Math.abs(theirs) * 10 ** (1 - digits) + 1e-12 ? [] : [`${path}: ${mine}, not ${theirs}`];
  }
  if (theirs !== null && typeof theirs === 'object' && mine !== null && typeof mine === 'object') {
    if (Array.isArray(theirs) && theirs.length !== mine.length) return [`${path}: ${mine.length} entries, not ${theirs.length}`];
    return Object.keys(theirs).flatMap((key) => differences(mine[key], theirs[key], `${path}/${key}`));
  }
  return mine === theirs ? [] : [`${path}: ${JSON.stringify(mine)}, not ${JSON.stringify(theirs)}`];
}

let compared = 0;
async function compare(program, machine, more = {}) {
  const file = join(examples, program);
  const name = basename(program);
  const request = {
    program: file,
    machine: { name: machine, text: readFileSync(join(examples, machine), 'utf8'), motor: null },
    dialect: 'linuxcnc', inches: false, block_delete: false, tools: '', proposals: true, ...more,
  };
  const printed = await run(['check', file, '-m', join(examples, machine), '--json']);
  const what = `${name} on ${basename(machine)}`;
  assert.notEqual(printed.out, '', `${what}: ${printed.err}`);
  const theirs = JSON.parse(printed.out);
  // The cost of a serial link needs the whole session: it is not in the module.
  delete theirs.line;
  const { answer, module, memory } = checkInModule({ [file]: readFileSync(file) }, request);
  assert.ok(answer.machine.good, what);
  assert.deepEqual(differences(answer, theirs), [], what);
  if (answer.path.points > 0) {
    const length = module.check_path(0, 0);
    const head = new DataView(memory.buffer, module.check_answer(), length);
    assert.equal(head.getUint32(0, true), 0x50534150, `${what}: a chunk of the path`);
  }
  assert.equal(module.check_path(answer.path.chunks, 0), 0);
  ++compared;
  return answer;
}

const programs = readdirSync(examples).filter((name) => name.endsWith('.ngc'));
// Motors that are simulated take seconds: with PASSO_FULL all programs, else the troubles below.
const machines = ['router', 'pantograph', 'uno', ...(process.env.PASSO_FULL ? ['strong-router', 'first-machine', 'gantry', 'forty-eight'] : [])];
for (const program of programs) {
  for (const machine of machines) await compare(program, `machines/${machine}.toml`);
}
await compare('probe-corner.ngc', 'machines/strong-router.toml');
const verdicts = new Map();
for (const name of readdirSync(join(examples, 'troubles')).filter((one) => one.endsWith('.ngc'))) {
  const answer = await compare(`troubles/${name}`, `troubles/${name.replace('.ngc', '.toml')}`);
  verdicts.set(name, answer.margin?.verdict);
}
assert.ok([...verdicts.values()].includes('lost'), 'a program of examples/troubles loses steps');

// Hostile requests and files: answered in words, never by a trap.
const router = readFileSync(join(examples, 'machines/router.toml'), 'utf8');
const ask = (bytes, machine = router, more = {}) =>
  checkInModule({ 'p.ngc': new Uint8Array(bytes) }, { program: 'p.ngc', machine: { name: 'm.toml', text: machine, motor: null }, ...more }).answer;
const codes = (answer) => answer.findings.map((one) => one.code);
const ascii = (text) => new TextEncoder().encode(text);
assert.equal(checkInModule({}, 'no JSON').answer.machine.good, false);
assert.equal(checkInModule({}, '[]').answer.machine.good, false);
assert.equal(checkInModule({}, '{"machine": {"text": 7}}').answer.machine.good, false);
assert.deepEqual(codes(checkInModule({}, { program: 'x', machine: { name: 'm', text: router } }).answer), ['file.not-found']);
assert.deepEqual(codes(ask([])), ['file.empty']);
assert.deepEqual(codes(ask(new Array(2000).fill(1))), ['file.binary']);
assert.equal(ask(ascii('G1 X1 F100\n'), 'name = "x\n').machine.findings[0].code, 'machine.syntax');
assert.equal(ask(ascii('G1 X1 F100\n'), `a = ${'['.repeat(100_000)}`).machine.good, false);
assert.equal(ask(ascii('G1 X'.repeat(100_000))).good, false);
assert.equal(ask(ascii(`#1=${'['.repeat(5000)}1${']'.repeat(5000)}\n`)).good, false);
assert.equal(ask(ascii('o1 while [1]\no1 endwhile\n')).good, false);
const wrong = ask(ascii('G21\nG1 X1O Y5 F100\n'));
assert.equal(wrong.findings[0].line, 2);
assert.equal(wrong.findings[0].text, 'G1 X1O Y5 F100');
assert.ok(wrong.findings[0].column > 0 && wrong.findings[0].expected !== undefined);
// A chosen motor is that of each axis without one.
const motor = { holding_torque_nm: 0.05, rated_current_a: 1.7, resistance_ohm: 1.5, inductance_mh: 2.8, rotor_inertia_g_cm2: 68, supply_v: 24, limits_motion: false, load_mass_kg: 20, friction_n: 30 };
const weak = ask(ascii('G21\nG0 X300\nG0 X0\n'), router, { machine: { name: 'm.toml', text: router, motor } });
assert.equal(weak.margin.verdict, 'lost');
assert.equal(weak.margin.worst_lines[0].axis, 'X');
// A subroutine in a file beside the program, and a tool table.
const called = checkInModule(
  { 'p.ngc': ascii('o<hole> call [3]\nT1 M6 G43\nM2\n'), 'hole.ngc': ascii('o<hole> sub\nG1 X#1 F100\no<hole> endsub\n'), 't.tbl': ascii('T1 P1 Z5 D3\n') },
  { program: 'p.ngc', machine: { name: 'm.toml', text: router }, tools: 't.tbl' },
).answer;
assert.deepEqual(codes(called).filter((one) => !one.startsWith('path.')), []);
assert.equal(called.good, true);
console.log(`${compared} checks are those of the program`);
