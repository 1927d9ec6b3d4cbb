-- From version 3 to 4: rows of the fault sample are the rarer the larger the draw's number, and say how
-- many draws they stand for. Those that are there stay: one in 1024.
ALTER TABLE fault_sample ADD COLUMN
  stands_for INTEGER NOT NULL DEFAULT 1024 CHECK (stands_for >= 1024 AND draw % stands_for = 0);

DROP VIEW faults;
CREATE VIEW faults AS
SELECT first_fault, fault_deg, count(*) AS sampled, sum(stands_for) AS draws,
       CAST(sum(stands_for) AS REAL) / (SELECT sum(stands_for) FROM fault_sample) AS share
FROM fault_sample
GROUP BY first_fault, fault_deg;

-- What older builds measured by: version 1 before the rates of change were there, then 2; builds of
-- schema 3 may have had 3 and do not say so.
ALTER TABLE run ADD COLUMN metrics_version INTEGER NOT NULL DEFAULT 1;
UPDATE run SET metrics_version = min(schema_version, 2);

PRAGMA user_version = 4;
