// French: all words of the page, but those of the lab (lab/lang) and what the server reports (faults.ts, findings.ts).
import { board } from './board';
import { cam } from './cam';
import { console } from './console';
import { files } from './files';
import { frame } from './frame';
import { job } from './job';
import { machine } from './machine';
import { operations } from './operations';
import { pins } from './pins';
import { run } from './run';
import { set_up } from './set_up';
import type { Words } from '../same';

export const fr: Words = { ...board, ...cam, ...console, ...files, ...frame, ...job, ...machine, ...operations, ...pins, ...run, ...set_up };
