// A real cncjs, headless, at a running `passo serve`: connects, asks, moves, jogs, holds, resets, and runs a program.
//
//   node drive.js LINK         LINK: the pseudo-terminal of `passo serve --grbl-pty LINK`
//
// Prints a line for each check. Ends with 0 if all are good. scripts/cncjs.sh starts it.
"use strict";

const { spawn } = require("child_process");
const fs = require("fs");
const http = require("http");
const os = require("os");
const path = require("path");
const io = require("socket.io-client");

const link = process.argv[2];
const home = fs.mkdtempSync(path.join(os.tmpdir(), "passo-cncjs-"));
const patience = 20000;  // ms, for each check

let server;
let failed = 0;
function leave(code) {
  if (server) server.kill();
  fs.rmSync(home, { recursive: true, force: true });
  process.exit(code);
}
function check(name, good, found) {
  console.log(`${good ? "ok  " : "FAIL"} ${name}${good ? "" : ": " + JSON.stringify(found)}`);
  if (!good) failed += 1;
}
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
async function until(name, is_so, found = () => undefined) {
  const end = Date.now() + patience;
  while (Date.now() < end && !is_so()) await sleep(20);
  check(name, is_so(), found());
}

// Asks cncjs for a token, as its page does; nobody is asked for a password.
function sign_in(port) {
  return new Promise((done, fail) => {
    const request = http.request(
      { host: "127.0.0.1", port, path: "/api/signin", method: "POST", headers: { "Content-Type": "application/json" } },
      (answer) => {
        let text = "";
        answer.on("data", (part) => { text += part; });
        answer.on("end", () => {
          try { done(JSON.parse(text).token); } catch (error) { fail(error); }
        });
      });
    request.on("error", fail);
    request.end("{}");
  });
}

// Port 0 would not be told, so a free one is looked for.
function free_port() {
  return new Promise((done) => {
    const probe = http.createServer().listen(0, "127.0.0.1", () => {
      const port = probe.address().port;
      probe.close(() => done(port));
    });
  });
}

async function start_cncjs() {
  const port = await free_port();
  fs.writeFileSync(path.join(home, "rc.json"), JSON.stringify({ state: { checkForUpdates: false } }));
  server = spawn(process.execPath,
    [require.resolve("cncjs/bin/cncjs"), "-H", "127.0.0.1", "--port", String(port), "-c", path.join(home, "rc.json")],
    { env: { ...process.env, HOME: home }, stdio: ["ignore", "ignore", "ignore"] });
  const end = Date.now() + patience;
  for (;;) {
    try {
      return { port, token: await sign_in(port) };
    } catch (error) {
      if (Date.now() > end) throw error;
      await sleep(100);
    }
  }
}

function program() {
  const lines = ["G21 G90 G94", "M3 S1000", "G0 X0 Y0 Z2"];
  for (let i = 0; i < 60; i += 1) {
    lines.push(`G1 X${(10 * Math.sin(i / 5)).toFixed(3)} Y${(10 * Math.cos(i / 5)).toFixed(3)} Z${-i / 100} F1500`);
  }
  lines.push("G2 X0 Y5 I-2 J-2 (an arc)".replace("I-2 J-2 ", "R20 "), "G4 P0.1", "G0 Z2", "G0 X12.5 Y-3.25", "M5", "M30");
  return lines.join("\n") + "\n";
}

async function main() {
  const { port, token } = await start_cncjs();
  const socket = io(`http://127.0.0.1:${port}`, { query: "token=" + token });
  const read = [];
  let settings = {};
  let state = {};
  let sender = {};
  let opened = false;
  const errors = [];
  socket.on("serialport:open", () => { opened = true; });
  socket.on("serialport:error", (error) => errors.push(error));
  socket.on("serialport:read", (line) => read.push(String(line)));
  socket.on("controller:settings", (type, value) => { settings = value; });
  socket.on("controller:state", (type, value) => { state = value; });
  socket.on("sender:status", (value) => { sender = value; });
  const status = () => (state.status || {});
  const active = () => status().activeState;
  const at = (axis) => Number((status().mpos || {})[axis]);
  const command = (...words) => socket.emit("command", link, ...words);
  const near = (axis, place) => Math.abs(at(axis) - place) < 0.006;

  await until("the page's socket is open", () => socket.connected);
  socket.emit("open", link, { controllerType: "Grbl", baudrate: 115200 });
  await until("the port is open", () => opened, () => errors);
  await until("it is a Grbl 1.1", () => String(settings.version).startsWith("1.1"), () => settings);
  await until("its settings are read", () => Number((settings.settings || {}).$110) > 0, () => settings.settings);
  await until("it asks for the status by itself", () => status().mpos !== undefined, () => state);
  await until("it asks for the modes by itself", () => (state.parserstate || {}).modal !== undefined, () => state);

  if (active() === "Alarm") command("unlock");
  await until("it is idle", () => active() === "Idle", active);
  const buffer = (settings.settings && settings.settings.$10) ? Number(settings.settings.$10) : -1;
  check("$10 shows the buffers", (buffer & 2) !== 0, buffer);

  command("gcode", "G21 G90 G0 X1 Y2");
  await until("a line by hand moves", () => near("x", 1) && near("y", 2) && active() === "Idle", status);
  command("gcode", "G91 X1\nX1\nX1\nG90");
  await until("several lines by hand move", () => near("x", 4) && active() === "Idle", status);
  command("jog", { X: 2, F: 1000, G: 91 });
  command("gcode", "$J=G91 X-1.5 F1200");
  await until("a jog moves", () => near("x", 2.5) && active() === "Idle", status);

  command("gcode:load", "part.nc", program(), {});
  await until("the program is loaded", () => sender.total > 60, () => sender);
  command("gcode:start");
  await until("the program runs", () => active() === "Run" && sender.sent > 3, () => [active(), sender]);
  command("feedhold");
  await until("a hold rests", () => active() === "Hold", active);
  const held = at("x");
  await sleep(300);
  check("nothing moves in a hold", near("x", held), [held, at("x")]);
  command("feedOverride", 10);
  command("cyclestart");
  await until("it goes on", () => active() === "Run", active);
  await until("the override counts", () => (status().ov || [])[0] === 110, status);
  await until("the program ends", () => sender.finishTime > 0, () => sender);
  await until("where it should", () => active() === "Idle" && near("x", 12.5) && near("y", -3.25), status);
  check("each line was answered", sender.received === sender.total, sender);

  command("gcode", "G1 X100 F300");
  await until("a long move runs", () => active() === "Run", active);
  command("reset");
  await until("a reset ends it", () => active() === "Idle" || active() === "Alarm", active);
  if (active() === "Alarm") command("unlock");
  await until("and the machine is ready again", () => active() === "Idle", active);
  command("gcode", "G90 G0 X0");
  await until("and moves", () => near("x", 0) && active() === "Idle", status);
  command("gcode", "G99");
  await until("a bad line is an error", () => read.some((line) => line.startsWith("error:")), () => read.slice(-5));

  socket.emit("close", link);
  check("nothing is left over", errors.length === 0, errors);
  console.log(failed === 0 ? "all checks passed" : `${failed} checks failed`);
  leave(failed === 0 ? 0 : 1);
}

setTimeout(() => { console.log("FAIL it took more than three minutes"); leave(1); }, 180000).unref();
main().catch((error) => { console.log("FAIL", error); leave(1); });
