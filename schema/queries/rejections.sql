-- Where along the folding draws fail first, in steps of 10 degrees, from the exact sample of one
-- draw in 1024.
WITH rejected AS (
  SELECT * FROM fault_sample WHERE draw NOT IN (SELECT draw FROM candidate)
)
SELECT first_fault, CAST(fault_deg / 10 AS INTEGER) * 10 AS from_deg, count(*) AS draws,
       CAST(count(*) AS REAL) / (SELECT count(*) FROM rejected) AS share
FROM rejected
GROUP BY first_fault, from_deg
ORDER BY first_fault, from_deg;
