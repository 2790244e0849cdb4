"""Named tuples of numbers and arrays for compiled functions, handed on as one pointer.

A tuple that is passed to a compiled function is copied, number by number, and where arrays are
counted each of them is, up and down in memory that all cores share: for the 60 arrays and 50
numbers of a bearing ten times the time of the physics of a ball, with the counting. `handle`
keeps the tuple where it is called; what it returns is read like the tuple, lives as long as
that call, and counts nothing.
"""

from numba import types
from numba.core import cgutils
from numba.core.datamodel import models
from numba.core.typing.templates import AttributeTemplate
from numba.extending import infer_getattr, intrinsic, lower_getattr_generic, register_model


class Handle(types.Type):
    """Type of a pointer to a named tuple."""

    def __init__(self, fields):
        self.fields = fields
        super().__init__(name=f"Handle({fields.name})")

    @property
    def key(self):
        """What tells two of them apart."""
        return self.fields


@register_model(Handle)
class HandleModel(models.PrimitiveModel):
    """One pointer."""

    def __init__(self, manager, handle):
        super().__init__(manager, handle, cgutils.voidptr_t)


@infer_getattr
class HandleFields(AttributeTemplate):
    """Fields of a handle: those of the tuple, named tuples in it as handles of their own."""

    key = Handle

    def generic_resolve(self, handle, name):
        """Type of a field."""
        if name not in handle.fields.fields:
            return None
        field = handle.fields[handle.fields.fields.index(name)]
        return Handle(field) if isinstance(field, types.BaseNamedTuple) else field


def uncounted(context, builder, kind, value):
    """A value whose arrays are not counted: those who lend them keep them."""
    if isinstance(kind, types.Array):
        array = context.make_array(kind)(context, builder, value=value)
        array.meminfo = cgutils.get_null_value(array.meminfo.type)
        array.parent = cgutils.get_null_value(array.parent.type)
        return array._getvalue()
    if isinstance(kind, types.BaseTuple):
        for i, part in enumerate(kind):
            inner = uncounted(context, builder, part, builder.extract_value(value, i))
            value = builder.insert_value(value, inner, i)
    return value


@lower_getattr_generic(Handle)
def read_field(context, builder, handle, value, name):
    """A field of a handle, or the handle of a named tuple in it."""
    index = handle.fields.fields.index(name)
    field = handle.fields[index]
    struct = context.get_value_type(handle.fields)
    place = cgutils.gep_inbounds(builder, builder.bitcast(value, struct.as_pointer()), 0, index)
    if isinstance(field, types.BaseNamedTuple):
        return builder.bitcast(place, cgutils.voidptr_t)
    return uncounted(context, builder, field, builder.load(place))


@intrinsic
def handle(typing, fields):
    """Handle of a named tuple, which must outlive it."""
    del typing
    if isinstance(fields, Handle):
        return fields(fields), lambda context, builder, signature, arguments: arguments[0]

    def build(context, builder, signature, arguments):
        kind = signature.args[0]
        room = cgutils.alloca_once(builder, context.get_value_type(kind))
        builder.store(uncounted(context, builder, kind, arguments[0]), room)
        return builder.bitcast(room, cgutils.voidptr_t)

    return Handle(fields)(fields), build
