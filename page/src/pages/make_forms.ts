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
  fields: readonly Field[];
}

const text = (option: string, title: Key, usual = ''): Field => ({ option, title, kind: 'text', usual });
const flag = (option: string, title: Key): Field => ({ option, title, kind: 'flag' });
const mirror: Field = {
  option: 'mirror',
  title: 'make.mirror',
  kind: 'choice',
  choices: [['x', 'make.mirror.x'], ['y', 'make.mirror.y']],
};
const zero: Field = { option: 'zero', title: 'make.zero', kind: 'choice', choices: [['lower-left', 'make.zero.low']] };
const ends = [text('clearance', 'make.clearance', '2mm'), text('spindle', 'make.spindle'), zero, mirror];
const milled = [text('feed', 'make.feed', '200mm'), text('plunge-feed', 'make.plunge', '60mm'), ...ends, flag('conventional', 'make.conventional')];

export const forms: readonly Form[] = [
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
      text('depth', 'make.depth', '-1.8mm'),
      text('step', 'make.step', '0.5mm'),
      text('tabs', 'make.tabs', '0'),
      text('tab-width', 'make.tabs.width', '2mm'),
      text('tab-height', 'make.tabs.height', '0.6mm'),
      text('ramp', 'make.ramp', '0'),
      text('lead', 'make.lead'),
      flag('dog-bones', 'make.dogbones'),
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
      {
        option: 'way',
        title: 'make.way',
        kind: 'choice',
        choices: [['rows', 'make.way.rows'], ['columns', 'make.way.columns'], ['both', 'make.way.both'], ['spiral', 'make.way.spiral']],
      },
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
