"""Find the off-screen OpenGL of this machine without importing OpenGL."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import sys

from grasptypes.errors import InputError

PLATFORM_VARIABLE = "PYOPENGL_PLATFORM"
ADVICE = "install it: apt-get install libegl1 libgl1-mesa-dri libosmesa6"
_EGL_PLATFORM_DEVICE = 0x313F  # EGL_EXT_platform_device


def choose_platform() -> str:
    """EGL if a display can be opened without a screen, else OSMesa; ``PYOPENGL_PLATFORM``
    overrides.

    Raises:
        InputError: neither works, or not the requested one; the message names the missing
            packages. Or Python runs without assertions, in which pyrender starts OpenGL.
    """
    if sys.flags.optimize:
        message = "OpenGL needs Python's assertions: run Python without -O and PYTHONOPTIMIZE"
        raise InputError("python -O", "", message)
    asked = os.environ.get(PLATFORM_VARIABLE)
    if not asked:
        for name, works in _PLATFORMS.items():
            if works():
                return name
        raise InputError(PLATFORM_VARIABLE, "", f"no off-screen OpenGL here; {ADVICE}")
    if asked not in _PLATFORMS:
        allowed = ", ".join(_PLATFORMS)
        raise InputError(PLATFORM_VARIABLE, "", f"is '{asked}'; allowed: {allowed}")
    if not _PLATFORMS[asked]():
        raise InputError(PLATFORM_VARIABLE, "", f"is '{asked}', which does not work here; {ADVICE}")
    return asked


def _osmesa_works() -> bool:
    """Whether OSMesa can be loaded."""
    try:
        ctypes.CDLL(ctypes.util.find_library("OSMesa") or "libOSMesa.so.8")
    except OSError:
        return False
    return True


def _egl_works() -> bool:
    """Whether EGL finds a device and can initialise a display on it."""
    try:
        egl = ctypes.CDLL(ctypes.util.find_library("EGL") or "libEGL.so.1")
    except OSError:
        return False
    egl.eglGetProcAddress.restype = ctypes.c_void_p
    query = egl.eglGetProcAddress(b"eglQueryDevicesEXT")
    display = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
    if not query or not display:
        return False
    devices = (ctypes.c_void_p * 1)()
    found = ctypes.c_int()
    int_p = ctypes.POINTER(ctypes.c_int)
    query_devices = ctypes.CFUNCTYPE(
        ctypes.c_uint, ctypes.c_int, ctypes.POINTER(ctypes.c_void_p), int_p
    )(query)
    get_display = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, int_p)(display)
    if not query_devices(1, devices, ctypes.byref(found)) or found.value < 1:
        return False
    handle = ctypes.c_void_p(get_display(_EGL_PLATFORM_DEVICE, devices[0], None))
    return bool(handle) and bool(egl.eglInitialize(handle, None, None))


_PLATFORMS = {"egl": _egl_works, "osmesa": _osmesa_works}
