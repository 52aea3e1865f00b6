// The jobs of `passo cam` as forms. A field that is left empty takes the default, which stands in it.
import type { Key } from '../core/language';

export interface Field {
  option: string;
  title: Key;
  kind: 'text' | 'flag' | 'choice' | 'file';
  usual?: string;
  choices?: readonly (readonly [string, Key])[];
}
export interface Form {
  job: string;
  title: Key;
  files: string; // what the file dialog offers
  withoutFiles?: string; // an option that needs no drawing
  fields: readonly Field[];
}

const text = (option: string, title: Key, usual = ''): Field => ({ option, title, kind: 'text', usual });
const flag = (option: string, title: Key): Field => ({ option, title, kind: 'flag' });
const choice = (option: string, title: Key, choices: readonly (readonly [string, Key])[]): Field => ({ option, title, kind: 'choice', choices });
const mirror = choice('mirror', 'make.mirror', [['x', 'make.mirror.x'], ['y', 'make.mirror.y']]);
const zero = choice('zero', 'make.zero', [['lower-left', 'make.zero.low']]);
const ends = [text('clearance', 'make.clearance', '2mm'), text('spindle', 'make.spindle'), zero, mirror];
const milled = [text('feed', 'make.feed', '200mm'), text('plunge-feed', 'make.plunge', '60mm'), ...ends, flag('conventional', 'make.conventional')];

// Of what is cut out along a line.
const cutOut = [
  text('depth', 'make.depth', '-1.8mm'),
  text('step', 'make.step', '0.5mm'),
  text('tabs', 'make.tabs', '0'),
  text('tab-width', 'make.tabs.width', '2mm'),
  text('tab-height', 'make.tabs.height', '0.6mm'),
  text('ramp', 'make.ramp', '0'),
  text('lead', 'make.lead'),
  flag('dog-bones', 'make.dogbones'),
];
const drawings = '.svg,.dxf';

export const forms: readonly [Form, ...Form[]] = [
  {
    job: 'profile',
    title: 'make.profile',
    files: drawings,
    fields: [
      choice('side', 'make.side', [['outside', 'make.side.outside'], ['inside', 'make.side.inside'], ['on', 'make.side.on']]),
      text('tool', 'make.tool', '2mm'),
      ...cutOut,
      text('layer', 'make.layer'),
      ...milled,
    ],
  },
  {
    job: 'pocket',
    title: 'make.pocket',
    files: drawings,
    fields: [
      text('tool', 'make.tool', '3mm'),
      text('depth', 'make.depth', '-3mm'),
      text('step', 'make.layers', '1mm'),
      text('step-over', 'make.over', '40'),
      text('ramp', 'make.ramp', '5'),
      text('layer', 'make.layer'),
      ...milled,
    ],
  },
  {
    job: 'engrave',
    title: 'make.engrave',
    files: `${drawings},.ttf,.otf`,
    withoutFiles: 'text',
    fields: [
      text('text', 'make.text'),
      { option: 'font', title: 'make.font', kind: 'file' },
      text('height', 'make.letters', '10mm'),
      choice('text-align', 'make.align', [['middle', 'make.align.middle'], ['right', 'make.align.right']]),
      text('around', 'make.around'),
      text('angle', 'make.angle', '60'),
      text('tip', 'make.tip', '0mm'),
      text('tool', 'make.widest', '6mm'),
      text('depth', 'make.deepest'),
      text('clear', 'make.clear.tool'),
      ...milled,
    ],
  },
  {
    job: 'drill',
    title: 'make.drill',
    files: '.drl,.xln,.exc,.txt,.dxf',
    fields: [
      text('depth', 'make.depth', '-2mm'),
      text('tools', 'make.tools'),
      text('drill', 'make.drill.one'),
      text('mill', 'make.drill.mill'),
      text('peck', 'make.peck'),
      text('feed', 'make.plunge', '100mm'),
      ...ends,
      flag('plain', 'make.plain'),
    ],
  },
  {
    job: 'isolate',
    title: 'make.isolate',
    files: '.gbr,.gtl,.gbl,.dxf,.top,.bot',
    fields: [
      text('tool', 'make.tools.width', '0.2mm'),
      text('v', 'make.v'),
      text('depth', 'make.depth', '-0.05mm'),
      text('passes', 'make.passes', '1'),
      text('width', 'make.free'),
      flag('clear', 'make.clear'),
      { option: 'edge', title: 'make.edge', kind: 'file' },
      ...milled,
    ],
  },
  {
    job: 'outline',
    title: 'make.outline',
    files: '.gbr,.gko,.gm1,.dxf',
    fields: [
      text('tool', 'make.tool', '2mm'),
      ...cutOut,
      ...milled,
    ],
  },
  {
    job: 'relief',
    title: 'make.relief',
    files: '.png,.stl,.csv,.xyz',
    fields: [
      text('width', 'make.width', '100mm'),
      text('depth', 'make.relief.depth', '3mm'),
      text('cutter', 'make.cutter', 'ball:3'),
      choice('way', 'make.way', [
        ['rows', 'make.way.rows'],
        ['columns', 'make.way.columns'],
        ['both', 'make.way.both'],
        ['spiral', 'make.way.spiral'],
      ]),
      text('scallop', 'make.scallop', '0.02mm'),
      text('rough', 'make.rough'),
      text('rest', 'make.rest'),
      flag('invert', 'make.invert'),
      flag('mirror', 'make.relief.mirror'),
      text('feed', 'make.feed', '1000mm'),
      text('plunge', 'make.plunge', '300mm'),
      text('clearance', 'make.clearance', '5mm'),
      text('spindle', 'make.spindle'),
    ],
  },
];

const kindOf = (name: string): string => (/\.[a-z0-9]+$/i.exec(name)?.[0] ?? '').toLowerCase();
const takes = (form: Form, kind: string): boolean => kind !== '' && form.files.split(',').includes(kind);

// The form that takes such a file: the one at hand if it does.
export const formFor = (name: string, atHand: Form): Form =>
  [atHand, ...forms].find((form) => takes(form, kindOf(name))) ?? atHand;
// Whether a file is a drawing or a picture, and no G-code.
export const isDrawing = (name: string): boolean => kindOf(name) !== '.txt' && forms.some((form) => takes(form, kindOf(name)));
