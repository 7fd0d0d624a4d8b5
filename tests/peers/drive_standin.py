#!/usr/bin/python3
"""tests/peers/drive_standin.py FAMILY tcp|rtu [DEVICE]

An inverter of one family as its manual tells it, on the Modbus server of python3-pymodbus: neither
its protocol code nor its register maps are rvbench's. The motor follows its reference at once.
Says "listening at PORT" or "listening at DEVICE" on standard error; each command that it was given
follows there: "state running, reference 20.17 Hz".
"""
import asyncio
import sys

from pymodbus.datastore import ModbusServerContext, ModbusSlaveContext
from pymodbus.server.async_io import ModbusSerialServer, ModbusTcpServer
from pymodbus.transaction import ModbusRtuFramer

POLE_PAIRS = 2
RATED_HZ = 50.0
READ, WRITE_ONE, WRITE_MANY = 3, 6, 16


def word(value):
    return int(round(value)) & 0xFFFF


def signed(value):
    return value - 0x10000 if value & 0x8000 else value


class Drive:
    """State, reference and what is read at each register."""

    blocks_are_written = True

    def __init__(self):
        self.state = "ready"
        self.reference_Hz = 0.0

    def output_Hz(self):
        return self.reference_Hz if self.state == "running" else 0.0

    def rpm(self):
        return self.output_Hz() * 60 / POLE_PAIRS


class Delta(Drive):
    """MS300: run bits at 2000H, frequency at 2001H; 2100H to 210CH tell."""

    blocks_are_written = False
    writes = (0x2000, 0x2001, 0x2002)

    def __init__(self):
        super().__init__()
        self.backwards, self.magnitude_Hz, self.fault = False, 0.0, 0x09

    def registers(self):
        running = 3 if self.state == "running" else 0
        direction = 3 if self.backwards else 0
        return {0x2100: self.fault, 0x2101: running | direction << 3 | 1 << 8 | 1 << 10,
                0x2103: word(100 * abs(self.output_Hz())), 0x2104: 123,
                0x210C: word(abs(self.rpm())), 0x0902: 1, 0x0903: 10}

    def write(self, at, value):
        if at == 0x2001:
            self.magnitude_Hz = value / 100
        elif at == 0x2002 and value & 2:
            self.fault = 0
        elif at == 0x2000 and not self.fault:
            self.state = {1: "ready", 2: "running"}.get(value & 3, self.state)
            if value >> 4 & 3:
                self.backwards = value >> 4 & 3 == 2
        self.reference_Hz = -self.magnitude_Hz if self.backwards else self.magnitude_Hz


class Ladder(Drive):
    """What the drives with a ladder of states share: bits of the control word move it."""

    # name: status word
    words = {}

    def __init__(self):
        super().__init__()
        self.state, self.last = "inhibited", 0

    def control(self, value):
        rising = value & ~self.last
        self.last = value
        if self.state == "fault":
            if rising & 0x80:
                self.state = "inhibited"
            return
        on, allowed, enabled = value & 1, (value & 6) == 6, value & 8
        if not allowed:
            self.state = "inhibited"
        elif self.state == "inhibited" and not on:
            self.state = "ready"
        elif self.state == "ready" and on and (value & 0xF) == 7:
            self.state = "switched_on"
        elif self.state in ("switched_on", "running"):
            self.state = "ready" if not on else "running" if enabled else "switched_on"


class Abb(Ladder):
    """ACS550, ABB DRV FULL: 40001 control, 40002 reference, 40004 status, 40005 actual."""

    writes = (0, 1)
    words = {"inhibited": 0x0270, "ready": 0x0231, "switched_on": 0x0233, "running": 0x0237,
             "fault": 0x0238}

    def __init__(self):
        super().__init__()
        self.state = "fault"

    def registers(self):
        return {3: self.words[self.state], 4: word(20000 * self.output_Hz() / RATED_HZ),
                3017: 1, 3018: 10}

    def write(self, at, value):
        if at == 1:
            self.reference_Hz = signed(value) / 20000 * RATED_HZ
        else:
            self.control(value)
        if self.last & 0x70 != 0x70 and self.state == "running":
            self.reference_Hz = 0.0  # the ramp's output is held at zero


class Altivar(Ladder):
    """CiA 402: 8501 control, 8602 speed; 3201 state, 3202 frequency, 8604 speed."""

    blocks_are_written = False
    writes = (8501, 8602)
    words = {"inhibited": 0x0250, "ready": 0x0231, "switched_on": 0x0233, "running": 0x0237,
             "fault": 0x0218}

    def __init__(self):
        super().__init__()
        self.state = "fault"

    def registers(self):
        return {3201: self.words[self.state], 3202: word(10 * self.output_Hz()), 3204: 12,
                8604: word(self.rpm()), 8606: 0, 6005: 10, 7010: 6}

    def write(self, at, value):
        if at == 8602:
            self.reference_Hz = signed(value) / 60 * POLE_PAIRS
        else:
            self.control(value)


class V20(Ladder):
    """STW 40100, HSW 40101; ZSW 40110, output 40024 to 40026; starts on an edge of bit 0."""

    blocks_are_written = False
    writes = (99, 100)
    words = {"inhibited": 0x0240, "ready": 0x0231, "running": 0x0237, "fault": 0x0208}

    def __init__(self):
        super().__init__()
        self.state, self.share = "fault", 0.0

    def registers(self):
        return {109: self.words[self.state], 23: word(100 * self.output_Hz()),
                24: word(self.rpm()), 25: 123, 53: 0, 0: 1000, 1: 1}

    def write(self, at, value):
        if at == 100:
            self.share = signed(value) / 16384
        else:
            rising = value & ~self.last
            self.last = value
            if self.state == "fault" and rising & 0x80:
                self.state = "inhibited"
            elif self.state == "inhibited" and not value & 1:
                self.state = "ready"
            elif self.state == "ready" and rising & 1 and value & 0x47E == 0x47E:
                self.state = "running"
            elif self.state == "running" and not value & 1:
                self.state = "ready"
        self.reference_Hz = self.share * RATED_HZ * (-1 if self.last & 0x800 else 1)


class Danfoss(Drive):
    """FC profile: CTW 50000, REF 50010, STW 50200, MAV 50210, counted from 1."""

    blocks_are_written = False
    writes = (49999, 50009)

    def __init__(self):
        super().__init__()
        self.state, self.share, self.last = "fault", 0.0, 0

    def registers(self):
        status = {"fault": 0x020A, "inhibited": 0x0203, "ready": 0x0207, "running": 0x0A07}
        speed = word(self.rpm()), 0xFFFF if self.rpm() < 0 else 0
        return {50199: status[self.state], 50209: word(16384 * self.output_Hz() / RATED_HZ),
                16139: 0, 16140: 250, 16169: speed[1], 16170: speed[0],
                8029: 0, 8030: 10, 8039: 2}

    def write(self, at, value):
        if at == 50009:
            self.share = signed(value) / 16384
        elif value & 0x400:  # data are valid
            if self.state == "fault":
                if value & ~self.last & 0x80:
                    self.state = "ready"
            elif not value & 8:
                self.state = "inhibited"  # coasts
            else:
                self.state = "running" if value & 0x40 else "ready"
            self.last = value
        self.reference_Hz = self.share * RATED_HZ * (-1 if self.last & 0x8000 else 1)


FAMILIES = {"delta_ms300": Delta, "abb_acs": Abb, "schneider_altivar": Altivar,
            "siemens_v20": V20, "danfoss_fc": Danfoss}


class Registers(ModbusSlaveContext):
    def __init__(self, drive):
        super().__init__(zero_mode=True)
        self.drive = drive

    def validate(self, fc_as_hex, address, count=1):
        wanted = range(address, address + count)
        if fc_as_hex == READ:
            return all(at in self.drive.registers() for at in wanted)
        if fc_as_hex == WRITE_MANY and not self.drive.blocks_are_written:
            return False
        return fc_as_hex in (WRITE_ONE, WRITE_MANY) and all(at in self.drive.writes for at in wanted)

    def getValues(self, fc_as_hex, address, count=1):
        if fc_as_hex != READ:  # the echo of what was written
            return [0] * count
        registers = self.drive.registers()
        return [registers[at] for at in range(address, address + count)]

    def setValues(self, fc_as_hex, address, values):
        for offset, value in enumerate(values):
            self.drive.write(address + offset, value)
        print(f"state {self.drive.state}, reference {self.drive.reference_Hz:.2f} Hz",
              file=sys.stderr, flush=True)


async def main():
    family, kind, *device = sys.argv[1:]
    context = ModbusServerContext(slaves=Registers(FAMILIES[family]()), single=True)
    if kind == "rtu":
        server = ModbusSerialServer(context, framer=ModbusRtuFramer, port=device[0], baudrate=9600)
        await server.start()
        print(f"listening at {device[0]}", file=sys.stderr, flush=True)
        await server.serve_forever()
        return
    server = ModbusTcpServer(context, address=("127.0.0.1", 0))
    serving = asyncio.ensure_future(server.serve_forever())
    while not server.server or not server.server.sockets:
        await asyncio.sleep(0.01)
    port = server.server.sockets[0].getsockname()[1]
    print(f"listening at {port}", file=sys.stderr, flush=True)
    await serving


asyncio.run(main())
