#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A router for WAMP, as much of one as the coordinator, the exporters and the clients of labgrid up to 24 need. It stands in for crossbar,
which Debian does not have. Usage: wamp_router.py PORT"""
import asyncio
import itertools
import sys

from autobahn.asyncio.websocket import WampWebSocketServerFactory
from autobahn.wamp import message, role

ROLES = {"broker": role.RoleBrokerFeatures(session_meta_api=True), "dealer": role.RoleDealerFeatures(caller_identification=True)}


class Realm:
    def __init__(self):
        self.numbers = itertools.count(1)
        self.topics = {}  # topic: (number of the subscription, sessions)
        self.procedures = {}  # name: (number of the registration, session)
        self.calls = {}  # number of the invocation: (caller, its request, callee)

    def publish(self, topic, args, kwargs=None, but=None):
        number, sessions = self.topics.get(topic, (0, ()))
        for session in list(sessions):
            if session is not but:
                session.send(message.Event(number, next(self.numbers), args=args, kwargs=kwargs))


class Session:
    """One connection. Nobody is asked for a ticket: it is a test."""

    _session_id = _authid = None  # by these names autobahn's transport shows a session in its log

    def __init__(self, realm):
        self.realm = realm

    def onOpen(self, transport):
        self.transport = transport

    def onMessage(self, each):
        getattr(self, "on_" + type(each).__name__.lower())(each)

    def onClose(self, _):
        self.leave()

    def send(self, each):
        if self.transport.isOpen():
            self.transport.send(each)

    def on_hello(self, hello):
        self._session_id, self._authid = next(self.realm.numbers), hello.authid or "coordinator"
        self.send(message.Welcome(self._session_id, ROLES, realm=hello.realm, authid=self._authid, authrole="public", authmethod="ticket"))
        self.realm.publish("wamp.session.on_join", [{"session": self._session_id, "authid": self._authid}])

    def on_goodbye(self, _):
        self.leave()
        self.send(message.Goodbye(message.Goodbye.DEFAULT_REASON))

    def leave(self):
        if self._session_id is None:
            return
        number, self._session_id = self._session_id, None
        for _, sessions in self.realm.topics.values():
            sessions.discard(self)
        self.realm.procedures = {name: each for name, each in self.realm.procedures.items() if each[1] is not self}
        for invocation, (caller, request, callee) in list(self.realm.calls.items()):
            if self in (caller, callee):
                del self.realm.calls[invocation]
                if callee is self:
                    caller.send(message.Error(message.Call.MESSAGE_TYPE, request, "wamp.error.canceled"))
        self.realm.publish("wamp.session.on_leave", [number])

    def on_subscribe(self, each):
        number, sessions = self.realm.topics.setdefault(each.topic, (next(self.realm.numbers), set()))
        sessions.add(self)
        self.send(message.Subscribed(each.request, number))

    def on_publish(self, each):
        self.realm.publish(each.topic, each.args, each.kwargs, but=None if each.exclude_me is False else self)
        if each.acknowledge:
            self.send(message.Published(each.request, next(self.realm.numbers)))

    def on_register(self, each):
        number, _ = self.realm.procedures.setdefault(each.procedure, (next(self.realm.numbers), self))
        self.send(message.Registered(each.request, number))

    def on_call(self, each):
        number, callee = self.realm.procedures.get(each.procedure, (0, None))
        if callee is None:
            self.send(message.Error(message.Call.MESSAGE_TYPE, each.request, "wamp.error.no_such_procedure", args=[each.procedure]))
            return
        invocation = next(self.realm.numbers)
        self.realm.calls[invocation] = (self, each.request, callee)
        callee.send(message.Invocation(invocation, number, args=each.args, kwargs=each.kwargs, caller=self._session_id))

    def on_yield(self, each):
        caller, request, _ = self.realm.calls.pop(each.request, (None, 0, None))
        if caller is not None:
            caller.send(message.Result(request, args=each.args, kwargs=each.kwargs))

    def on_error(self, each):
        caller, request, _ = self.realm.calls.pop(each.request, (None, 0, None))
        if caller is not None:
            caller.send(message.Error(message.Call.MESSAGE_TYPE, request, each.error, args=each.args, kwargs=each.kwargs))


async def serve(port):
    realm = Realm()
    factory = WampWebSocketServerFactory(lambda: Session(realm), loop=asyncio.get_running_loop())
    async with await asyncio.get_running_loop().create_server(factory, "127.0.0.1", port) as server:
        print("ready", flush=True)
        await server.serve_forever()


if __name__ == "__main__":
    asyncio.run(serve(int(sys.argv[1])))
