# Crumple with compiled kernels:
#   docker build --tag crumple .
#   docker run --rm --user "$(id -u)" --volume "$PWD:/work" crumple run smoke
# The kernels are compiled for the processor that builds the image; another one compiles its own.
FROM python:3.13-slim AS build
WORKDIR /source
COPY . .
RUN pip wheel --no-cache-dir --no-deps --wheel-dir /wheels . \
    && sed -n 's/ *\\$//; /^[a-z0-9]/p' requirements.lock > /wheels/pins.txt

FROM python:3.13-slim
ENV CRUMPLE_CACHE_DIR=/opt/crumple MPLCONFIGDIR=/tmp/matplotlib
COPY --from=build /wheels /wheels
RUN pip install --no-cache-dir --constraint /wheels/pins.txt /wheels/*.whl && rm -r /wheels \
    && crumple warm && chmod -R a+rwX /opt/crumple \
    && useradd --create-home --uid 1000 crumple
USER 1000
WORKDIR /work
ENTRYPOINT ["crumple"]
CMD ["--help"]
