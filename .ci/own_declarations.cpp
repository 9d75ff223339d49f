// A plugin of clang-tidy, whose one check has every other look at our own declarations alone.
//
// clang-tidy 14 matches all that a source includes, and drops at the end what it finds in system
// headers: two thirds of its time go into those.
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <clang/ASTMatchers/ASTMatchFinder.h>
#include <clang/ASTMatchers/ASTMatchers.h>
#include <clang/Basic/SourceManager.h>

#include <vector>

namespace {

using clang::ast_matchers::MatchFinder;

class OwnDeclarations : public clang::tidy::ClangTidyCheck {
 public:
  using ClangTidyCheck::ClangTidyCheck;

  void registerMatchers(MatchFinder* finder) override {
    finder->addMatcher(clang::ast_matchers::translationUnitDecl(), this);
  }

  // The unit as a whole is matched before any of its declarations, which are then taken from the
  // scope that is set here.
  void check(const MatchFinder::MatchResult& found) override {
    const clang::SourceManager& sources = *found.SourceManager;
    std::vector<clang::Decl*> own;
    for (clang::Decl* each : found.Context->getTranslationUnitDecl()->decls()) {
      const clang::SourceLocation at = sources.getExpansionLoc(each->getLocation());
      if (at.isValid() && !sources.isInSystemHeader(at)) own.push_back(each);
    }
    found.Context->setTraversalScope(own);
  }
};

class OwnModule : public clang::tidy::ClangTidyModule {
  void addCheckFactories(clang::tidy::ClangTidyCheckFactories& factories) override {
    factories.registerCheck<OwnDeclarations>("own-declarations");
  }
};

const clang::tidy::ClangTidyModuleRegistry::Add<OwnModule> kAdded("own",
                                                                  "Bounds of what is looked at.");

}  // namespace
