-- Where along the folding draws fail first, in steps of 10 degrees, from the exact sample: about how
-- many draws its rows stand for. Those of catalogues from before version 4, which do not say it,
-- stand for 1024 each: there the inner name is none of fault_sample's, but the outer query's.
WITH sampled AS (
  SELECT first_fault, fault_deg, deploys_from_sample,
         (SELECT stands_for FROM fault_sample AS same WHERE same.draw = held.draw) AS draws
  FROM (SELECT 1024 AS stands_for) AS before_4, fault_sample AS held
),
rejected AS (
  SELECT first_fault, fault_deg, draws
  FROM sampled
  WHERE first_fault = 'undecided' OR deploys_from_sample < (
    SELECT round(json_extract(configuration, '$.accept.deploys_from_deg')
                 / json_extract(configuration, '$.path.sample_deg')) FROM campaign)
)
SELECT first_fault, CAST(fault_deg / 10 AS INTEGER) * 10 AS from_deg, count(*) AS sampled,
       sum(draws) AS draws, CAST(sum(draws) AS REAL) / (SELECT sum(draws) FROM rejected) AS share
FROM rejected
GROUP BY first_fault, from_deg
ORDER BY first_fault, from_deg;
