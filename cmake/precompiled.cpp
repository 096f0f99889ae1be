// A target of precompiled headers must have a source.
