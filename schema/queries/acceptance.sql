-- Numbers of draws: all, accepted, rejected and undecided, with the acceptance rate.
SELECT * FROM acceptance;
