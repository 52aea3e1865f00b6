// The style sheet of `passo check --report`. Colours are pairs for light and dark mode; paper is light.
#pragma once

namespace passo {

inline constexpr const char* check_style = R"(
:root { color-scheme: light dark;
  --paper: #fff; --ink: #1d2026; --quiet: #5c626d; --rule: #d9dce1; --tint: #f4f5f7; --sheet: #fff;
  --fill: #3b6ea8; --warn: #c2571a; --good: #1d6f42; --bad: #b3261e; }
@media (prefers-color-scheme: dark) { :root {
  --paper: #16181c; --ink: #e6e8eb; --quiet: #a3a9b3; --rule: #363a42; --tint: #1f2228; --sheet: #e9eaec;
  --fill: #6ea3dd; --warn: #f0904f; --good: #6fce9b; --bad: #ff8a80; } }
@media print { :root { color-scheme: light;
  --paper: #fff; --ink: #000; --quiet: #444; --rule: #bbb; --tint: #f4f5f7; --sheet: #fff;
  --fill: #3b6ea8; --warn: #c2571a; --good: #1d6f42; --bad: #b3261e; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 64rem; padding: 1.5rem 1rem 3rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
h1 { margin: 0; font-size: 1.6rem; line-height: 1.25; overflow-wrap: anywhere; }
h2 { margin: 2.2rem 0 .6rem; padding-bottom: .2rem; border-bottom: 1px solid var(--rule); font-size: 1.15rem; }
p { margin: .5rem 0; max-width: 46rem; }
.quiet, figcaption, th { color: var(--quiet); }
.badges { display: flex; flex-wrap: wrap; gap: .4rem; margin: .9rem 0; padding: 0; list-style: none; }
.badges li { padding: .1rem .7rem; border: 1px solid currentColor; border-radius: 1rem; font-weight: 600; }
.good { color: var(--good); } .doubt { color: var(--warn); } .bad { color: var(--bad); }
dl { display: grid; grid-template-columns: repeat(auto-fit, minmax(9rem, 1fr)); gap: .6rem; margin: 1rem 0; }
dl div { padding: .5rem .8rem; background: var(--tint); border-radius: .4rem; }
dt { color: var(--quiet); font-size: .85rem; } dd { margin: 0; font-size: 1.2rem; font-variant-numeric: tabular-nums; }
.table { overflow-x: auto; }
table { width: 100%; border-collapse: collapse; font-variant-numeric: tabular-nums; }
th { font-size: .85rem; font-weight: 500; text-align: left; }
th, td { padding: .3rem .7rem .3rem 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
.n { text-align: right; white-space: nowrap; }
.bar { display: block; height: .8rem; min-width: 2px; margin-top: .35rem; background: var(--fill); }
td.bars { width: 36%; }
figure { margin: 1rem 0; }
figcaption { margin-bottom: .3rem; font-size: .9rem; }
.views { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(22rem, 100%), 1fr)); gap: 1rem; }
.views figure { margin: 0; }
.views svg, .views img { display: block; width: 100%; height: auto; background: var(--sheet); border-radius: .4rem; }
.plot { position: relative; margin-left: 4.2rem; height: 9rem; border-left: 1px solid var(--rule); }
.plot svg { display: block; width: 100%; height: 100%; }
.plot .y { position: absolute; right: 100%; margin-right: .5rem; transform: translateY(50%); font-size: .85rem;
  white-space: nowrap; color: var(--quiet); line-height: 1; }
.plot .fill { fill: var(--fill); } .plot .warn { fill: var(--warn); }
.plot line { stroke: var(--rule); stroke-width: 1; vector-effect: non-scaling-stroke; }
.times { display: flex; justify-content: space-between; margin: .2rem 0 0 4.2rem; font-size: .85rem; color: var(--quiet); }
.findings { margin: 0; padding: 0; list-style: none; }
.findings li { margin: .7rem 0; padding-left: .8rem; border-left: .25rem solid var(--warn); overflow-wrap: anywhere; }
.findings li.error { border-color: var(--bad); }
pre { margin: .2rem 0; padding: .3rem .6rem; overflow-x: auto; background: var(--tint); font-size: .9rem; }
mark { background: none; color: inherit; text-decoration: underline; text-decoration-thickness: .15em;
  text-decoration-color: var(--warn); text-underline-offset: .2em; font-weight: 700; }
code { font-size: .9em; color: var(--quiet); }
footer { margin-top: 3rem; font-size: .85rem; color: var(--quiet); }
@media (max-width: 36rem) {
  .stack thead { display: none; }
  .stack tr { display: block; padding: .5rem 0; border-bottom: 1px solid var(--rule); }
  .stack td { display: block; border: 0; padding: 0; text-align: left; }
  .stack td[data-h]::before { content: attr(data-h) ": "; color: var(--quiet); }
  .stack td.bars { width: auto; } .times span:nth-child(even) { display: none; } }
@page { margin: 14mm; }
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  h2 { break-after: avoid; } tr, figure, .findings li, dl { break-inside: avoid; } .table, pre { overflow: visible; }
  pre { white-space: pre-wrap; } .bar, .plot svg, dl div { print-color-adjust: exact; }
  .views { grid-template-columns: 1fr 1fr; } }
)";

}  // namespace passo
