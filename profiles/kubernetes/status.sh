#!/bin/sh
# Status of a Job in Snakemake's terms. No answer counts as running: Snakemake asks again.
state=$(kubectl get "$1" --ignore-not-found \
    --output 'jsonpath=found {range .status.conditions[*]}{.type}={.status} {end}') || state="found "
case "$state" in
    *" Complete=True "*) echo success ;;
    *" Failed=True "* | "") echo failed ;;
    *) echo running ;;
esac
