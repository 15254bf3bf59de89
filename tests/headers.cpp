// Nothing: the target compiles the headers that the tests share.
