"""What goes wrong, by kind. Every exception of casimir is a `casimir.Error`."""


class Error(Exception):
    """The base of all exceptions of casimir."""


class CaseError(Error, ValueError):
    """A case, or an expression, that cannot be read.

    `str(error)` is the whole message with the offending line. `text` is what is wrong, `file`,
    `line` and `column` (from 1; line 0 where only the file is known) say where, and `hint` is a
    proposal such as "did you mean 'M3'?", or None.
    """

    def __init__(self, message, text="", file="", line=0, column=0, hint=""):
        super().__init__(message)
        self.text = text or message
        self.file = file
        self.line = line
        self.column = column
        self.hint = hint or None

    def __reduce__(self):
        return type(self), (*self.args, self.text, self.file, self.line, self.column, self.hint or "")


class ModelError(Error, ValueError):
    """A mathematical object that cannot be made, or that exact algebra cannot treat."""


class SingularPoint(Error, ValueError):
    """A point that other variables cannot describe."""


class RequestError(Error, ValueError):
    """Something was asked for that cannot be done: an unknown method, contradicting settings."""


class NoAnswer(Error, RuntimeError):
    """A search ended without an answer: out of time, memory or work."""


class EnvironmentProblem(Error, OSError):
    """The machine lacks something: no C++ compiler, nowhere to write."""


class UndecidedError(Error, RuntimeError):
    """An undecided verdict was taken for true or false."""
