#!/bin/bash
# Machines the pockets and profiles of the example jobs, each operation alone by its command, and prints their time on
# examples/machines/router.toml. Of the pockets it also prints the largest engagement, the share of the cutting distance with
# more than 70 % of the diameter engaged, and the largest removal rate: scripts/machining_table.sh [JOB…]
#
# BEFORE=PROGRAM: another version of passo, for a second row of each job. Options that it does not have are left out in both.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
exec python3 - "$root" "${PASSO:-$root/build/release/passo}" "${BEFORE:-}" "$@" <<'PYTHON'
import json, os, re, subprocess, sys, tempfile, tomllib
root, passo, before = sys.argv[1:4]
jobs = sys.argv[4:] or sorted(f[:-5] for f in os.listdir(f"{root}/examples/jobs") if f.endswith(".toml"))
commands = {"pocket": "pocket", "profile": "profile"}
of_all = ["clearance", "change-height"]
of_job = {"kind", "tool", "title", "drawing", "coolant"}

def words(key, value):
    if value is True: return [f"--{key}"]
    if value is False: return []
    if isinstance(value, list) and value and not isinstance(value[0], str):
        rows = value if isinstance(value[0], list) else [value]
        return [f"--{key}={','.join(map(str, row))}" for row in rows]
    return [f"--{key}={one}" for one in (value if isinstance(value, list) else [value])]

def run(program, *order):
    done = subprocess.run([program, *order], capture_output=True, text=True)
    if done.returncode != 0: raise RuntimeError(" ".join(order) + "\n" + done.stderr)
    return done.stdout

unknown = set()  # options that the other version does not have

def plan(program, order):
    while True:
        known = [one for one in order if one.split("=")[0] not in unknown]
        try:
            return run(program, *known)
        except RuntimeError as why:
            missing = re.search(r"has no option (--[a-z-]+)", str(why))
            if missing is None: raise
            unknown.add(missing[1])

def feeds_of(job, number, folder):
    """The tool with its feeds, from the chip load for the material where the job gives none."""
    tool = job["tool"][number]
    if "feed_mm_min" in tool: return tool
    with open(f"{folder}/tools.toml", "w", encoding="utf-8") as library:
        library.write("[tool.1]\n")
        library.writelines(f"{key} = {json.dumps(value)}\n" for key, value in tool.items() if key != "spindle_rpm")
    order = ["tools", "feeds", f"{folder}/tools.toml", "-t", "1", "--material", job["stock"]["material"], "--json"]
    found = json.loads(run(passo, *order, *([f"--rpm={tool['spindle_rpm']}"] if "spindle_rpm" in tool else [])))
    return tool | {"feed_mm_min": found["feed_mm_min"], "plunge_mm_min": found["plunge_mm_min"], "spindle_rpm": round(found["rpm"])}

def measure(program, job, folder):
    drawings = job["job"].get("drawing", [])
    drawings = [f"{root}/examples/jobs/{d}" for d in ([drawings] if isinstance(drawings, str) else drawings)]
    zero = job["job"].get("zero", "file")
    stock = job["stock"]
    x, y = stock.get("corner", [0, 0])
    block = f"X{x}:{x + stock['size'][0]},Y{y}:{y + stock['size'][1]},Z{-stock['thickness'] - 1}:0"
    time = engagement = removal = heavy = distance = 0.0
    count = 0
    for operation in job["operation"]:
        command = commands.get(operation["kind"])
        if command is None: continue
        tool = feeds_of(job, str(operation["tool"]), folder)
        order = ["cam", command, *drawings, f"--tool={tool['diameter_mm']}", "-o", f"{folder}/cut.ngc"]
        order += words("zero", zero if isinstance(zero, str) else [zero])
        for key, option in (("feed_mm_min", "feed"), ("plunge_mm_min", "plunge-feed"), ("spindle_rpm", "spindle")):
            if key in tool: order.append(f"--{option}={tool[key]}")
        for key, value in ({key: job["job"][key] for key in of_all if key in job["job"]} | operation).items():
            if key not in of_job: order += words(key, value)
        plan(program, order)
        count += 1
        checked = subprocess.run([passo, "check", "-m", f"{root}/examples/machines/router.toml", f"{folder}/cut.ngc", "--json"],
                                 capture_output=True, text=True)
        time += json.loads(checked.stdout)["time_s"]
        if command != "pocket": continue
        cut = json.loads(run(passo, "simulate", f"{folder}/cut.ngc", f"--tool=flat:{tool['diameter_mm']}", f"--stock={block}", "--json"))
        engagement = max(engagement, cut["largest_engagement"]["of_diameter"])
        removal = max(removal, cut["largest_removal"]["mm3_s"])
        heavy += cut["heavy_engagement"]["way_mm"]
        distance += cut["cutting_way_mm"]
    return count, time, engagement, heavy, distance, removal

print(f"{'job':18} {'version':8} {'operations':>10} {'time':>7} {'engagement %':>13} {'above 70 %':>11} {'mm3/s':>7}")
sums = {}

def row(name, version, count, time, engagement, heavy, distance, removal):
    pockets = f"{100 * engagement:13.0f} {100 * heavy / distance:9.0f} % {removal:7.0f}" if distance else ""
    print(f"{name:18} {version:8} {count:10} {int(time) // 60:4}:{int(time) % 60:02} {pockets}".rstrip(), flush=True)

with tempfile.TemporaryDirectory() as folder:
    for name in jobs:
        job = tomllib.load(open(f"{root}/examples/jobs/{name}.toml", "rb"))
        for version, program in (("before", before), ("now", passo)):
            if not program: continue
            try:
                found = measure(program, job, folder)
            except RuntimeError as why:
                print(f"{name:18} {version:8} {str(why).splitlines()[-1][:90]}")
                continue
            if found[0] == 0: break
            row(name, version, *found)
            sum = sums.setdefault(version, [0] * len(found))
            for i, value in enumerate(found): sum[i] = max(sum[i], value) if i in (2, 5) else sum[i] + value
for version, sum in sums.items(): row("all", version, *sum)
PYTHON
