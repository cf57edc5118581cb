# The workflow and its environment. Build: docker build -t grasptypes . ; run: docs/cluster.md.
FROM python:3.11-slim

# `make setup` cannot install the GL library without root; kubectl is for profiles/kubernetes.
COPY workflow/envs/apt.txt /tmp/
RUN apt-get update \
    && apt-get install --yes --no-install-recommends git kubernetes-client make $(grep -v '^#' /tmp/apt.txt) \
    && rm -rf /var/lib/apt/lists/*

RUN useradd --create-home --uid 1000 grasptypes && install -d -o grasptypes /opt/grasptypes
USER grasptypes
WORKDIR /opt/grasptypes

# The CPU build of torch, if its index is given: --build-arg TORCH_INDEX=<URL> (docs/quick_start_workflow.md).
ARG TORCH_INDEX=""
COPY --chown=grasptypes requirements.lock ./
RUN [ -z "$TORCH_INDEX" ] || { python3 -m venv .venv \
    && .venv/bin/pip install --no-cache-dir --index-url "$TORCH_INDEX" $(grep -oE '^torch(vision)?==[^ ]+' requirements.lock); }

# Environment files first, so that a changed parameter or rule does not reinstall it.
ENV PIP_NO_CACHE_DIR=1
COPY --chown=grasptypes Makefile hatch_build.py pyproject.toml README.md LICENSE ./
COPY --chown=grasptypes workflow/envs workflow/envs
COPY --chown=grasptypes src src
RUN make setup

COPY --chown=grasptypes . .
ENV PATH=/opt/grasptypes/.venv/bin:$PATH DVC_NO_ANALYTICS=1 MLFLOW_DISABLE_TELEMETRY=true
# Usage; most `make` targets need more of a checkout than the image contains.
CMD ["sed", "-n", "/^## In a container/,$p", "/opt/grasptypes/docs/cluster.md"]
