"""Download the authors' table of grasps from the URL given by the user."""

import os

from grasptypes.jobs import job
from grasptypes.labels.label_sources import fetch_published

if __name__ == "__main__":
    with job(snakemake.log) as log:
        found = fetch_published(os.environ, snakemake.output.table, snakemake.params.timeout_s)
        log.info("%s, SHA-256 %s", *found)
