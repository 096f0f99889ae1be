#!/usr/bin/env bash
# A study by GNU parallel: parallel.sh FOLDER 40 [options of parallel, e.g. --jobs 8, or --sshloginfile nodes]
# FOLDER as 'voussoir study plan' made it. 40 shares, as many at a time as there are cores.
set -euo pipefail
folder=$1 shares=$2
seq "$shares" | parallel --quote "${@:3}" voussoir study run "$folder" --jobs 1 --chunk "{}/$shares"
