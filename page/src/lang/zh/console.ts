// Chinese. The Console tab.
import type { console as en } from '../en/console';
import type { Same } from '../same';

export const console: Same<typeof en> = {
  'console.title': '控制台',
  'console.type': '输入一行 G 代码',
  'console.send': '发送',
  'console.search': '搜索日志',
  'console.log': '日志',
  'console.empty': '还没有内容。',
  'console.nothing': '没有包含这些文字的日志。',
  'console.modes': '当前模态',
  'console.help': '模态在各行之间一直有效，直到运行程序或机床复位。$G、$#、$$、$H 和 $X 的用法与 Grbl 相同；!\u00a0暂停，~\u00a0继续。按向上键可调出以前的行。',
};
