FROM python:3.13-slim AS tree
# hadolint ignore=DL3008
RUN apt-get update && apt-get install -y --no-install-recommends libegl1 libgl1-mesa-dri && rm -rf /var/lib/apt/lists/*
WORKDIR /ssilang
COPY . .
FROM tree AS tests
RUN python3 -m venv .venv && .venv/bin/pip install uv && .venv/bin/uv pip install -p .venv -e '.[test]' && .venv/bin/python -m pytest
FROM tree
RUN python3 -m venv .venv && .venv/bin/pip install . && .venv/bin/ssilang cases/club_cast3m_2014/club_b_sdm.ssi
ENTRYPOINT ["/ssilang/.venv/bin/ssilang"]
