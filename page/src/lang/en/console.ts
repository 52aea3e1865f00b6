// English. The Console tab.
export const console = {
  'console.title': 'Console',
  'console.type': 'A line of G-code',
  'console.send': 'Send',
  'console.search': 'Search the log',
  'console.log': 'Log',
  'console.empty': 'The log is empty.',
  'console.nothing': 'No log entry contains these words.',
  'console.modes': 'Active modes',
  'console.help': 'Modal codes stay active from line to line until a program runs or the machine is reset. $G, $#, $$, $H and $X work as in Grbl; !\u00a0holds, ~\u00a0resumes. The up arrow key recalls earlier lines.',
} as const;
