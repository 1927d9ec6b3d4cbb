-- How many draws were made, and what became of them.
SELECT * FROM acceptance;
