-- From version 5 to 6: splitting searches.
-- Of a splitting search (search/splitting/README.md): its levels, 1, 2, ..., as scores in 1024ths of a
-- sample; the last is the campaign's criterion. Since version 6, here and below.
CREATE TABLE level (
  number INTEGER PRIMARY KEY CHECK (number >= 1),
  score INTEGER NOT NULL CHECK (score > 0),
  deploys_from_deg REAL NOT NULL
) STRICT;

-- What became of each population at each level that it came to; at level 0 of its first draws. Its unit
-- holds its numbers, 10^10 of them, of which its candidates have some.
CREATE TABLE population (
  unit INTEGER NOT NULL REFERENCES unit (lo),
  level INTEGER NOT NULL CHECK (level >= 0),
  particles INTEGER NOT NULL CHECK (particles > 0),
  survivors INTEGER NOT NULL CHECK (survivors BETWEEN 0 AND particles),  -- that have reached the next one
  ancestors INTEGER NOT NULL CHECK (ancestors BETWEEN 0 AND survivors),  -- first draws that these descend from
  tried INTEGER NOT NULL CHECK (tried >= 0),                     -- draws, or moves
  taken INTEGER NOT NULL CHECK (taken BETWEEN 0 AND tried),      -- moves that stayed within the level
  undecided INTEGER NOT NULL CHECK (undecided BETWEEN 0 AND tried - taken),
  met INTEGER NOT NULL CHECK (met >= 0),  -- different candidates, kept or not
  seconds REAL NOT NULL CHECK (seconds >= 0),
  PRIMARY KEY (unit, level)
) STRICT, WITHOUT ROWID;

-- By which a candidate of a splitting search is known when it is met again: XXH3-128 of its
-- displacements_mm. It has the least of its numbers.
CREATE TABLE sheet (
  draw INTEGER PRIMARY KEY REFERENCES candidate (draw),
  hash BLOB NOT NULL CHECK (length(hash) = 16)
) STRICT;

CREATE INDEX sheet_by_hash ON sheet (hash);

-- What is done of populations that are under way: particles lo to hi - 1 of one at a level. Gone once the
-- population is in the ledger.
CREATE TABLE piece (
  population INTEGER NOT NULL CHECK (population >= 0),
  level INTEGER NOT NULL CHECK (level >= 0),
  lo INTEGER NOT NULL CHECK (lo >= 0),
  hi INTEGER NOT NULL CHECK (hi > lo),
  layout TEXT NOT NULL,  -- of the result: a build that has another makes the piece again
  result BLOB NOT NULL,
  PRIMARY KEY (population, level, lo)
) STRICT, WITHOUT ROWID;

-- Of a splitting search: each level with the mean over populations of their estimates of the share of
-- draws that deploy from it; sums over them of particles, of those that reached the next level, of the
-- first draws that these descend from, and of moves tried and taken. `misalign query acceptance` and
-- `status` have its interval as well.
CREATE VIEW ladder AS
WITH RECURSIVE way (unit, level, share) AS (
  SELECT lo, 0, 1.0 FROM unit WHERE EXISTS (SELECT 1 FROM level)
  UNION ALL
  SELECT unit, level + 1, share * survivors / particles FROM way JOIN population USING (unit, level)
  WHERE level < (SELECT max(number) FROM level)
)
SELECT way.level, (SELECT deploys_from_deg FROM level WHERE number = way.level) AS deploys_from_deg,
       sum(share) / (SELECT count(*) FROM unit) AS rate, sum(share > 0) AS populations_here,
       sum(particles) AS particles, sum(survivors) AS survivors, sum(ancestors) AS ancestors,
       sum(tried) AS tried, sum(taken) AS taken, sum(undecided) AS undecided, sum(met) AS met,
       sum(seconds) AS worker_seconds
FROM way LEFT JOIN population USING (unit, level)
GROUP BY way.level;

PRAGMA user_version = 6;
