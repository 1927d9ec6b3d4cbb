-- From version 9 to 10: at which level tables were asked.
ALTER TABLE run ADD COLUMN tables_deg REAL;

PRAGMA user_version = 10;
