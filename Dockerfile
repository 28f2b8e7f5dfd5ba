# canopen-conform with what with-vcan needs, for pipelines. docs/pipelines.md tells how it is built and used.
FROM debian:bookworm-slim AS build
WORKDIR /src
COPY scripts/install-packages scripts/
RUN scripts/install-packages build && apt-get -qq install -y --no-install-recommends dpkg-dev file
COPY . .
RUN cmake -S . -B /build -G Ninja -D CMAKE_BUILD_TYPE=Release -D BUILD_TESTING=OFF && cmake --build /build && cd /build && cpack

FROM debian:bookworm-slim
COPY --from=build /build/*.deb /tmp/
# cmake and a compiler are for the firmware; with-vcan compiles a helper on processors with AMX.
RUN apt-get -qq update \
    && apt-get -qq install -y --no-install-recommends /tmp/*.deb user-mode-linux iproute2 cmake make gcc g++ libc6-dev git \
    && rm -rf /tmp/*.deb /var/lib/apt/lists/*
