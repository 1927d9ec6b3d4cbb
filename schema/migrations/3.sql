-- From version 2 to 3: a goal for the acceptance rate, what committing costs, indexes for what people
-- sort by, and units that stay where they are.
ALTER TABLE campaign ADD COLUMN goal_relative_error REAL CHECK (goal_relative_error > 0);
ALTER TABLE run ADD COLUMN commits INTEGER;
ALTER TABLE run ADD COLUMN commit_s REAL;
ALTER TABLE run ADD COLUMN longest_commit_s REAL;

CREATE TRIGGER unit_moves BEFORE UPDATE OF lo, hi ON unit
BEGIN
  SELECT RAISE(ABORT, 'what is in the ledger stays there');
END;

CREATE INDEX candidate_best ON candidate (deploys_from_deg DESC, slope_min_mm_per_deg DESC);
CREATE INDEX candidate_robust ON candidate (slope_min_mm_per_deg DESC);
CREATE INDEX candidate_simplest ON candidate (shifted_vertices, deploys_from_deg DESC);
CREATE INDEX candidate_smooth ON candidate (slope_between_min_mm_per_deg DESC) WHERE bump_deg IS NULL;
CREATE INDEX candidate_stroke ON candidate (stroke_min DESC);

PRAGMA user_version = 3;
