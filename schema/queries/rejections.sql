-- Where along the folding draws fail first, in steps of 10 degrees, from the exact sample of one
-- draw in 1024.
SELECT first_fault, CAST(fault_deg / 10 AS INTEGER) * 10 AS from_deg, sum(draws) AS draws,
       sum(share) AS share
FROM faults
GROUP BY first_fault, from_deg
ORDER BY first_fault, from_deg;
