#!/usr/bin/env bash
# Makes candidates.csv again (about a minute of one core), then the tables and the figure from it.
set -euo pipefail
cd "$(dirname "$0")/../.."
study=${1:-build/release/tests/miscut_study}
one() { "$study" "search/campaigns/$1.json" "$2" "$3" 200 0.05; }
{
  one miura-6x6 170 150
  one ring-6x6 150 125
  one miura-4x4 150 125
  one miura-8x6 150 100
} | awk 'NR == 1 || !/^campaign,/' > results/miscut/candidates.csv
python3 results/miscut/correlations.py
