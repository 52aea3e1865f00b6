-- Machines, jobs, checks and attempts. Times are seconds since 1970.

-- Programs and machine files, by their SHA-256 in hexadecimal.
CREATE TABLE contents (
  hash TEXT PRIMARY KEY,
  data BYTEA NOT NULL
);

CREATE TABLE machines (
  name TEXT PRIMARY KEY,
  url TEXT NOT NULL UNIQUE,
  token TEXT NOT NULL,
  machine_file TEXT NOT NULL REFERENCES contents (hash),
  labels TEXT NOT NULL,     -- these three: words, each with its line feed
  materials TEXT NOT NULL,  -- that the machine can cut
  tools TEXT NOT NULL,      -- loaded now
  stock TEXT NOT NULL,      -- on the table now; empty: none
  heard_at DOUBLE PRECISION NOT NULL,  -- 0: never
  status TEXT NOT NULL      -- JSON, as the machine gave it
);

CREATE TABLE jobs (
  id {identity},
  name TEXT NOT NULL,
  program TEXT NOT NULL REFERENCES contents (hash),
  quantity BIGINT NOT NULL CHECK (quantity > 0),
  material TEXT NOT NULL,  -- empty: any
  tools TEXT NOT NULL,
  stock TEXT NOT NULL,     -- empty: any
  labels TEXT NOT NULL,    -- that a machine must have
  priority BIGINT NOT NULL,
  due_at DOUBLE PRECISION NOT NULL,  -- 0: none
  owner TEXT NOT NULL,
  state BIGINT NOT NULL,   -- FarmJobState
  created_at DOUBLE PRECISION NOT NULL
);
CREATE INDEX jobs_by_state ON jobs (state, id);

-- Whether a program is good on a machine file, by one version of Passo.
CREATE TABLE checks (
  program TEXT NOT NULL REFERENCES contents (hash),
  machine_file TEXT NOT NULL REFERENCES contents (hash),
  passo TEXT NOT NULL,
  state BIGINT NOT NULL,  -- CheckState
  planned_s DOUBLE PRECISION NOT NULL,
  findings TEXT NOT NULL,
  worker TEXT NOT NULL,
  taken_until DOUBLE PRECISION NOT NULL,
  PRIMARY KEY (program, machine_file, passo)
);
CREATE INDEX checks_by_state ON checks (state, taken_until);

-- One part on one machine. The machine's own history has the attempt's id before the first move.
CREATE TABLE attempts (
  id TEXT PRIMARY KEY,
  job BIGINT NOT NULL REFERENCES jobs (id),
  machine TEXT NOT NULL REFERENCES machines (name),
  operator TEXT NOT NULL,
  state BIGINT NOT NULL,  -- AttemptState; below 3: it is open
  why TEXT NOT NULL,
  claimed_at DOUBLE PRECISION NOT NULL,
  started_at DOUBLE PRECISION NOT NULL,
  ended_at DOUBLE PRECISION NOT NULL
);
CREATE INDEX attempts_by_job ON attempts (job, state);
-- A machine makes one part at a time, whatever a program believes.
CREATE UNIQUE INDEX open_attempt_of_machine ON attempts (machine) WHERE state < 3;
