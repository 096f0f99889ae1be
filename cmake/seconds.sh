#!/usr/bin/env bash
# seconds.sh SECONDS: for the last lines of make's targets: how long ago make began, or without make the SECONDS of the script.
now=$(date +%s)
echo "$((now - ${VOUSSOIR_STARTED:-$((now - $1))})) s"
